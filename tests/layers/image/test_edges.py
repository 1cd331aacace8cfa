from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial import cKDTree

from relieffab.grid import Grid
from relieffab.layers.image.edges import draw
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.make import layers_of
from relieffab.layers.mesh import make_mesh
from relieffab.layers.shading import default_lights, lambert
from relieffab.layers.view import View, place
from relieffab.subject.shapes import torus


@pytest.fixture(scope="module")
def tile(stone):
    """A square block that stands in front of a level ground, its top a roof."""
    grid = stone.grid
    i, j = np.indices(grid.shape)
    mask = (np.abs(i - 120) < 100) & (np.abs(j - 160) < 140)
    block = (np.abs(i - 120) < 50) & (np.abs(j - 160) < 50)
    depth = np.where(block, 9.0 - 1.0 * np.abs(j - 160) * grid.pitch, 0.0)
    normals = np.zeros((*grid.shape, 3))
    normals[..., 2] = 1.0
    side = np.where(j < 160, -1.0, 1.0) / np.sqrt(2)
    normals[block] = np.stack([side, 0 * side, np.full(side.shape, 1 / np.sqrt(2))], axis=2)[block]
    return replace(
        stone, depth=depth, normals=normals, mask=mask, strokes=(),
        lines=np.zeros(grid.shape), lights=default_lights(),
        shading=lambert(normals, default_lights()),
    )  # fmt: skip


def length(strokes, kind):
    return sum(np.hypot(*np.diff(s.points, axis=0).T).sum() for s in strokes if s.kind == kind)


def test_jumps_are_contours_and_ridges_creases(tile):
    strokes = draw(tile, Drawing())
    side = 100 * tile.pitch
    assert length(strokes, "crease") == pytest.approx(side, rel=0.15)
    assert length(strokes, "contour") == pytest.approx(4 * side, rel=0.15)
    assert {s.kind for s in draw(tile, Drawing(kinds=("outline",)))} == {"outline"}


def test_steps_of_brightness_are_a_photographs_contours(tile):
    i, j = np.indices(tile.grid.shape)
    disc = np.hypot(i - 120, j - 160) < 60
    strokes = draw(tile, Drawing(kinds=("contour",)), 0.3 + 0.5 * disc)
    x, y = tile.grid.to_xy(120.5, 160.5)
    points = np.concatenate([s.points for s in strokes])
    np.testing.assert_allclose(np.hypot(*(points - [x, y]).T), 60 * tile.pitch, atol=2 * tile.pitch)
    assert length(strokes, "contour") > 0.9 * 2 * np.pi * 59 * tile.pitch


def test_even_shading_is_no_step_for_its_little_noise(tile):
    i, j = np.indices(tile.grid.shape)
    off = np.hypot(i - 120, j - 160) / 110
    ball = replace(tile, mask=off < 1)
    grey = np.sqrt(np.clip(1 - off**2, 0, None)) + 0.003 * np.random.default_rng(0).normal(
        size=off.shape
    )
    only = Drawing(kinds=("contour",))
    assert length(draw(ball, only, grey), "contour") < 4 * tile.pitch
    marked = draw(ball, only, grey - 0.3 * (np.abs(j - 160) < 6) * (np.abs(i - 120) < 60))
    assert length(marked, "contour") > 0.9 * 2 * 120 * tile.pitch


def ring_seen(elevation):
    """A torus from that high, at 320 x 240."""
    mesh = make_mesh(*torus(2.0, 0.9, (240, 120)), usual_up="z")
    placed = place(mesh, View(elevation=elevation), (40.0, 30.0), margin=3.0)
    return layers_of(placed, Grid.on_panel((40.0, 30.0), (320, 240)))


def along(strokes, kind):
    """Points along the strokes of a kind, close together."""
    pieces = [
        np.linspace(a, b, 20) for s in strokes if s.kind == kind for a, b in pairwise(s.points)
    ]
    return np.concatenate(pieces)


@pytest.mark.parametrize(
    ("kind", "elevation", "off"), [("contour", 20.0, 0.3), ("suggestive", 35.0, 0.7)]
)
def test_lines_lie_where_the_meshs_do(kind, elevation, off):
    seen = ring_seen(elevation)
    strokes = draw(replace(seen, strokes=(), lines=np.zeros(seen.grid.shape)), Drawing())
    mine, theirs = along(strokes, kind), along(seen.strokes, kind)
    assert np.quantile(cKDTree(theirs).query(mine)[0], 0.75) < off
    assert np.quantile(cKDTree(mine).query(theirs)[0], 0.75) < off
