"""The picture belongs to the model, not to its mesh."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from relieffab.grid import Grid
from relieffab.layers.eye import Eye
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.strokes import draw_strokes
from relieffab.layers.mesh import make_mesh
from relieffab.layers.raster import rasterise
from relieffab.layers.view import Placed, View, place
from relieffab.subject import shapes

GRID = Grid.on_panel((120.0, 90.0), (1024, 768))
MIDDLE = np.array([60.0, 45.0, 0.0])
SMALL = Grid.on_panel((40.0, 30.0), (320, 240))


def lumps(unit):
    """Distance of a lumpy stone: forms that hide each other, and dimples."""
    x, y, z = unit.T
    return 32 * (
        1
        + 0.25 * np.sin(3 * x + 1) * np.sin(4 * y)
        + 0.15 * np.cos(5 * z + 2 * x)
        + 0.05 * np.sin(9 * x) * np.sin(8 * y + z)
    )


def spin(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def drawn(vertices, faces, grid=GRID, eye=None, **options):
    placed = Placed.seen_from(eye or Eye(), vertices, faces, np.eye(4))
    raster = rasterise(placed.vertices, placed.faces, grid)
    return draw_strokes(placed, raster, grid, Drawing(**options))


def along(strokes, step=0.05):
    """Points along all strokes, evenly."""
    out = []
    for stroke in strokes:
        points = stroke.points
        if stroke.closed:
            points = np.concatenate([points, points[:1]])
        arc = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        at = np.arange(0, arc[-1], step)
        out.append(np.stack([np.interp(at, arc, q) for q in points.T], axis=1))
    return np.concatenate(out)


def shared(one, two, within):
    """The lesser share of either's length that lies that near the other, mm."""
    return min((cKDTree(a).query(b)[0] <= within).mean() for a, b in ((one, two), (two, one)))


@pytest.fixture(scope="module")
def finest():
    vertices, faces = shapes.star(lumps, 160_000)
    strokes = drawn(vertices + MIDDLE, faces)
    kinds = {stroke.kind for stroke in strokes}
    assert kinds == {"outline", "contour", "suggestive"}
    return along(strokes)


@pytest.mark.parametrize("count", [10_000, 40_000])
def test_at_any_number_of_vertices(finest, count):
    vertices, faces = shapes.star(lumps, count)
    points = along(drawn(vertices + MIDDLE, faces))
    assert shared(points, finest, GRID.pitch) > 0.95


def test_another_stone_has_another_picture(finest):
    vertices, faces = shapes.star(lambda unit: lumps(unit[:, [1, 0, 2]]), 10_000)
    points = along(drawn(vertices + MIDDLE, faces))
    assert shared(points, finest, GRID.pitch) < 0.5


@pytest.mark.parametrize("degrees", [33.0, 90.0])
def test_triangles_turned_under_the_model(finest, degrees):
    turn = spin(degrees)
    vertices, faces = shapes.star(lambda unit: lumps(unit @ turn.T), 40_000)
    points = along(drawn(vertices @ turn.T + MIDDLE, faces))
    assert shared(points, finest, GRID.pitch) > 0.95


@pytest.mark.parametrize("degrees", [33.0, 90.0])
def test_the_model_turned_in_the_picture(finest, degrees):
    turn = spin(degrees)
    vertices, faces = shapes.star(lumps, 40_000)
    wide = Grid.on_panel((120.0, 120.0), (1024, 1024))
    points = along(drawn(vertices @ turn.T + [60, 60, 0], faces, wide))
    back = (points - 60) @ turn[:2, :2] + [60, 45]
    assert shared(back, finest, GRID.pitch) > 0.95


SHAPE = shapes.star(lambda unit: lumps(unit) / 3.2, 3000)


def seen(vertices, faces):
    mesh = make_mesh(vertices, faces)
    placed = place(mesh, View(25, 10), (40.0, 30.0), margin=2.0)
    raster = rasterise(placed.vertices, placed.faces, SMALL)
    return draw_strokes(placed, raster, SMALL, Drawing(detail=1.0, min_length=1.0, spacing=0.3))


ONE = seen(*SHAPE)


def same(strokes):
    assert [s.kind for s in strokes] == [s.kind for s in ONE]
    assert shared(along(strokes), along(ONE), 0.5 * SMALL.pitch) > 0.99


@settings(max_examples=8, deadline=None)
@given(st.floats(-4, 4), st.tuples(*[st.floats(-1e3, 1e3)] * 3))
def test_scale_and_place(power, shift):
    vertices, faces = SHAPE
    scale = 10.0**power
    same(seen(scale * (vertices + np.array(shift)), faces))


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_order_of_faces_corners_and_vertices(seed):
    vertices, faces = SHAPE
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(vertices))
    place_of = np.argsort(order)
    turned = np.stack(
        [np.roll(f, k) for f, k in zip(faces, rng.integers(0, 3, len(faces)), strict=True)]
    )
    same(seen(vertices[order], place_of[rng.permutation(turned)]))


@settings(max_examples=4, deadline=None)
@given(st.floats(0, 1), st.integers(0, 2**32 - 1))
def test_inside_out_whole_or_in_part(share, seed):
    vertices, faces = SHAPE
    over = np.random.default_rng(seed).random(len(faces)) < share
    same(seen(vertices, np.where(over[:, None], faces[:, ::-1], faces)))


def test_from_an_eye_contours_are_those_of_what_is_seen():
    vertices, faces = shapes.torus(8.0, 3.4, (160, 100))
    c, s = np.cos(1.2), np.sin(1.2)
    solid = vertices @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]]).T + [20, 15, -12]
    eye = Eye(18.0, 17.0, 1 / 40)
    kinds = {"kinds": ("outline", "contour"), "detail": 0.0, "min_length": 1.0}
    one = along(drawn(solid, faces, SMALL, eye, **kinds))
    two = along(drawn(eye.project(solid), faces, SMALL, **kinds))
    assert shared(one, two, SMALL.pitch) > 0.97
    straight = along(drawn(solid, faces, SMALL, **kinds))
    assert shared(one, straight, SMALL.pitch) < 0.5


def test_a_ball_from_an_eye_is_a_circle_of_its_cone():
    vertices, faces = shapes.sphere(6.0, 20_000)
    eye = Eye(20.0, 15.0, 1 / 30)
    (circle,) = drawn(vertices + np.array([20.0, 15.0, -10.0]), faces, SMALL, eye)
    # The eye sees a cone of half-angle asin(6/40) and its circle on Z0, 30 mm off.
    radius = 30 * np.tan(np.arcsin(6 / 40))
    off = np.linalg.norm(circle.points - [20, 15], axis=1) - radius
    assert np.abs(off).max() < 0.5 * SMALL.pitch
