import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.lines.image import line_image, spread_ink
from relieffab.layers.model import Stroke

GRID = Grid(60, 80, 0.25, (1.0, 16.0))


def stroke(points, strength=1.0, kind="contour", closed=False):
    points = np.asarray(points, float)
    return Stroke(points, kind, np.broadcast_to(strength, len(points)).astype(float), closed)


def test_ink_is_the_area_covered():
    line = stroke([[4, 6], [15, 12]])
    image = line_image([line], GRID, width=1.0)
    fine = 9
    row, col = np.meshgrid(
        (np.arange(60 * fine) + 0.5) / fine, (np.arange(80 * fine) + 0.5) / fine, indexing="ij"
    )
    x, y = GRID.to_xy(row, col)
    a, d = line.points[0], np.diff(line.points, axis=0)[0]
    t = np.clip(((x - a[0]) * d[0] + (y - a[1]) * d[1]) / (d @ d), 0, 1)
    inside = np.hypot(x - a[0] - t * d[0], y - a[1] - t * d[1]) < 0.5
    covered = inside.reshape(60, fine, 80, fine).mean(axis=(1, 3))
    assert np.abs(image - covered).max() < 0.15
    assert image.sum() == pytest.approx(covered.sum(), rel=0.01)


def test_strength_scales_ink_and_the_darker_stroke_counts():
    image = line_image([stroke([[4, 6], [15, 6]], 0.4)], GRID, width=1.0)
    assert image.max() == pytest.approx(0.4)
    both = [stroke([[4, 6], [15, 6]], 0.4), stroke([[4, 6], [15, 6]], 0.3)]
    np.testing.assert_array_equal(line_image(both, GRID, width=1.0), image)
    ramp = line_image([stroke([[2, 6], [18, 6]], [0.0, 1.0])], GRID, width=1.0)
    row = int(GRID.to_index(0, 6.1)[0])
    assert (np.diff(ramp[row, 8:66]) > 0).all()


def test_a_hairline_has_the_ink_of_its_width():
    image = line_image([stroke([[4, 6.125], [15, 6.125]])], GRID, width=0.05)
    assert image.max() == pytest.approx(0.2)


def test_closed_strokes_close_and_single_points_are_dots():
    square = [[4, 4], [12, 4], [12, 12], [4, 12]]
    open_one = line_image([stroke(square)], GRID, width=0.5)
    closed = line_image([stroke(square, closed=True)], GRID, width=0.5)
    row, col = (int(q) for q in GRID.to_index(4.0, 8.0))
    assert open_one[row, col] == 0 and closed[row, col] > 0.9


def test_far_off_strokes_and_none_leave_no_ink():
    assert line_image([], GRID, width=1.0).shape == (60, 80)
    assert line_image([stroke([[-50, -50], [-40, 90]])], GRID, width=1.0).max() == 0


def test_spreading_dilates_and_erodes_by_a_disc():
    dot = np.zeros(GRID.shape)
    dot[30, 40] = 0.7
    wide = spread_ink(dot, 0.75, GRID)  # three pixels
    i, j = np.nonzero(wide)
    assert (np.hypot(i - 30, j - 40) <= 3).all() and len(i) == 29
    assert set(wide[wide > 0]) == {0.7}
    back = spread_ink(wide, -0.75, GRID)
    np.testing.assert_array_equal(back, dot)
    np.testing.assert_array_equal(spread_ink(dot, 0.2, GRID), dot)


def test_a_line_spread_by_a_third_of_its_width_is_bolder():
    line = line_image([stroke([[4, 6.125], [15, 6.125]])], GRID, width=0.75)
    assert spread_ink(line, 0.25, GRID).sum() > 1.5 * line.sum()
    assert spread_ink(line, -0.25, GRID).sum() < 0.5 * line.sum()
