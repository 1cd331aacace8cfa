import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.strokes import draw_strokes
from relieffab.layers.lines.study import Study
from relieffab.layers.raster import rasterise
from relieffab.layers.view import View, place

SIZE, DRAWING = (120.0, 90.0), Drawing(detail=1.5)


def placed(model, view, margin=6.0):
    return place(model, view, SIZE, margin=margin)


@pytest.mark.parametrize("perspective", [0.0, 40.0])
def test_a_study_turned_is_the_study_made_there(model, perspective):
    here = placed(model, View(azimuth=20, up="y"))
    there = placed(model, View(azimuth=50, elevation=20, roll=30, up="y", perspective=perspective))
    turned = Study.of(here, DRAWING).seen(there)
    detail, shortest = turned.lengths
    made = Study.of(there, Drawing(detail=detail, min_length=shortest))
    one, other = turned.surface, made.surface
    np.testing.assert_allclose(one.vertices, other.vertices, atol=1e-9)
    np.testing.assert_allclose(one.view, other.view, atol=1e-9)
    np.testing.assert_allclose(one.bend.normals, other.bend.normals, atol=1e-5)
    np.testing.assert_allclose(one.bend.areas, other.bend.areas, rtol=1e-4)
    # Principal directions may swap where both bend alike; what the lines see may not.
    mean, there_mean = (s.bend.principal.sum(axis=0) for s in (one, other))
    np.testing.assert_allclose(mean, there_mean, atol=1e-4 * np.abs(there_mean).max())
    assert one.radius == pytest.approx(other.radius, rel=1e-5)


def test_it_draws_the_same_lines(model):
    grid = Grid.on_panel(SIZE, (256, 192))
    here, there = (placed(model, View(azimuth=a, up="y")) for a in (0, 25))
    raster = rasterise(there.vertices, there.faces, grid)
    turned = Study.of(here, DRAWING).seen(there)
    detail, shortest = turned.lengths
    drawing = Drawing(detail=detail, min_length=shortest)
    fresh = draw_strokes(there, raster, grid, drawing)
    again = draw_strokes(there, raster, grid, drawing, study=turned)
    assert [s.kind for s in fresh] == [s.kind for s in again]
    assert any(s.kind == "suggestive" for s in fresh)
    for one, other in zip(fresh, again, strict=True):
        assert len(one.points) == pytest.approx(len(other.points), abs=2)
        np.testing.assert_allclose(one.points.mean(axis=0), other.points.mean(axis=0), atol=0.05)


def test_it_serves_views_and_drawings_of_nearly_its_lengths(model):
    here = placed(model, View(up="y"))
    study = Study.of(here, DRAWING)
    assert study.serves(here, DRAWING)
    assert not study.serves(here, Drawing(detail=1.7))
    assert not study.serves(here, Drawing(detail=1.5, min_length=4.0))
    smaller = placed(model, View(up="y"), margin=20.0)
    assert not study.serves(smaller, DRAWING)
