"""What else a relief can be asked for: parts of it, grooves of a tip, nothing out of reach."""

import numpy as np
import pytest
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.model import Layers, Stroke
from relieffab.relief.edge import wall
from relieffab.relief.make import make_relief
from relieffab.relief.reach import ball, closing
from relieffab.relief.solve import solve_heights
from relieffab.relief.targets import Carving


@pytest.fixture(scope="module")
def drawn(layers):
    """A line across the figure, as ink and as a stroke."""
    lines = np.zeros(layers.grid.shape)
    lines[:, 79:81] = 1.0
    x, y = layers.grid.to_xy(np.array([20.0, 100.0]), np.array([80.0, 80.0]))
    stroke = Stroke(np.stack([x, y], axis=1), "contour", np.ones(2))
    return Layers(**{**vars(layers), "lines": lines, "strokes": (stroke,)})


def groove(relief, layers):
    """Depth of the groove under the line against the surface beside it, row by row."""
    rows = ndimage.binary_erosion(layers.mask, iterations=10)[:, 80]
    h = relief.heights[:-1][rows]
    return (h[:, 72] + h[:, 88]) / 2 - h[:, 76:85].min(axis=1)


def test_lines_alone_leave_the_face_level(drawn):
    relief, _ = make_relief(drawn, Carving(depth=1.0, carve="lines", wall_angle=90.0))
    away = ndimage.binary_erosion(drawn.mask, iterations=8)
    away[:, 70:91] = False
    assert np.abs(relief.heights[:-1, :-1][away]).max() < 0.02
    assert np.median(groove(relief, drawn)) > 0.7


def test_an_outline_is_cut_on_both_sides(layers):
    mask = layers.mask
    edge = ndimage.binary_dilation(mask, iterations=2) ^ ndimage.binary_erosion(mask, iterations=2)
    outlined = Layers(**{**vars(layers), "lines": edge.astype(float)})
    relief, _ = make_relief(outlined, Carving(depth=1.0, carve="lines", fillet=0.0))
    row = relief.heights[60]
    left = np.nonzero(layers.mask[60])[0][0]
    assert row[left - 1] < -0.3
    assert row[left + 1] < -0.3
    assert abs(row[left + 12]) < 0.02


def test_the_surface_alone_is_that_of_a_model_without_lines(drawn, layers):
    carving = Carving(depth=1.5, carve="surface")
    bare, _ = make_relief(Layers(**{**vars(layers), "strokes": ()}), carving)
    relief, _ = make_relief(drawn, carving)
    np.testing.assert_array_equal(relief.heights, bare.heights)


def test_a_groove_takes_the_tips_shape_and_is_solved_with_the_surface(drawn):
    def vee(r):
        return np.asarray(r, float)

    carving = Carving(depth=1.5, line_depth=0.5, line_tip=vee, fillet=0.0, line_weight=40.0)
    relief, _ = make_relief(drawn, carving, tolerance=1e-4)
    plain, _ = make_relief(drawn, Carving(depth=1.5, carve="surface", fillet=0.0))
    cut = (relief.heights - plain.heights)[50:70, 74:87]
    cut -= cut[:, [0, -1]].mean(axis=1, keepdims=True)
    away = drawn.pitch * np.abs(np.arange(74, 87) - 80)
    want = np.minimum(away - 0.5, 0.0)
    assert np.abs(np.median(cut, axis=0) - (want - want[0])).max() < 0.08


def test_what_no_tip_reaches_is_given_up_while_solving(drawn):
    short, energy = [], []
    edge = wall(drawn.mask, drawn.pitch, 80.0, 1.5)
    for reachable in (None, lambda heights, pitch: closing(heights, pitch, ball(1.0))):
        carving = Carving(depth=1.5, line_depth=0.5, fillet=1.0, reachable=reachable)
        s = solve_heights(drawn, carving, edge, tolerance=1e-4)
        walled = np.maximum(s.heights, edge)
        short.append((closing(walled, drawn.pitch, ball(1.0)) - walled).max())
        energy.append(s.energy["total"])
    assert short[0] > 0.05
    assert short[1] < 0.2 * short[0]
    assert energy[1] > energy[0]


def test_a_part_that_is_not_known_is_refused():
    with pytest.raises(InputError, match="nothing of that name"):
        Carving(carve="shadow")


@pytest.mark.parametrize("depth", [0.3, 1.0, 4.0, 9.0])
def test_more_depth_never_gives_less_detail(layers, depth):
    def spread(d):
        relief, _ = make_relief(layers, Carving(depth=d, wall_angle=90.0))
        inner = ndimage.binary_erosion(layers.mask, iterations=8)
        h = relief.heights
        fine = h - ndimage.gaussian_filter(h, 4)
        return fine[:-1, :-1][inner].std()

    assert spread(1.3 * depth) > 0.99 * spread(depth)
