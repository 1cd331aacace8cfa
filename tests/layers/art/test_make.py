import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.art.art import Art, Mark, Ring
from relieffab.layers.art.make import layers_of_art, placed_on

GRID = Grid.on_panel((40.0, 30.0), (320, 240))
SQUARE = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)


def art(*marks, page=None):
    return Art(marks, page, "a", "svg")


def square(**more):
    return Mark((Ring(SQUARE, True),), **more)


def test_art_without_a_size_fits_the_room_and_art_with_one_keeps_it():
    (scale, _, x), *_ = np.array(placed_on(art(square(fill="nonzero")), (40.0, 30.0), margin=3.0))
    assert (scale, x) == (pytest.approx(2.4), pytest.approx(8.0))
    fixed = placed_on(art(square(fill="nonzero"), page=(20.0, 20.0)), (40.0, 30.0), margin=3.0)
    assert fixed == [[1.0, 0.0, 10.0], [0.0, -1.0, 25.0], [0.0, 0.0, 1.0]]


def test_art_larger_than_the_panel_is_refused():
    far = Mark((Ring(SQUARE * 4, True),), fill="nonzero")
    with pytest.raises(InputError, match="beyond the panel"):
        placed_on(art(far, page=(40.0, 40.0)), (40.0, 30.0), margin=3.0)


def test_fills_are_figure_and_paper_takes_them_away():
    inner = Mark((Ring(SQUARE / 2, True),), fill="nonzero", paper=True)
    page = art(square(fill="nonzero"), inner)
    layers = layers_of_art(page, GRID, placed_on(page, (40.0, 30.0), margin=3.0))
    assert layers.level
    assert layers.mask.sum() * GRID.pitch**2 == pytest.approx(0.75 * 24**2, rel=0.01)
    assert not layers.lines.any()
    assert [stroke.kind for stroke in layers.strokes] == ["outline"]


def test_strokes_are_lines_of_their_own_width():
    page = art(square(width=1.0), page=(20.0, 20.0))
    layers = layers_of_art(page, GRID, placed_on(page, (40.0, 30.0), margin=3.0))
    assert layers.lines.sum() * GRID.pitch**2 == pytest.approx(40.0, rel=0.03)
    assert [(s.kind, s.closed) for s in layers.strokes] == [("drawn", True)]


def test_outlined_fills_are_lines():
    page = art(square(fill="nonzero"))
    layers = layers_of_art(page, GRID, placed_on(page, (40.0, 30.0), margin=3.0), outlined=True)
    assert [stroke.kind for stroke in layers.strokes] == ["drawn"]
    assert layers.lines.sum() * GRID.pitch**2 == pytest.approx(4 * 24 * 0.6, rel=0.05)


def test_paper_alone_is_nothing():
    page = art(square(fill="nonzero", paper=True))
    with pytest.raises(InputError, match="dark enough"):
        layers_of_art(page, GRID, placed_on(page, (40.0, 30.0), margin=3.0))
