import numpy as np
import pytest
from scipy import ndimage
from scipy.spatial import cKDTree
from skimage.draw import polygon2mask

from relieffab.grid import Grid
from relieffab.layers.lines.outline import outlines

GRID = Grid(300, 400, 0.1, (0.0, 30.0))


def centres():
    row, col = np.mgrid[0:300, 0:400]
    return GRID.to_xy(row + 0.5, col + 0.5)


def test_a_disc_and_its_hole_within_half_a_pixel():
    x, y = centres()
    off = np.hypot(x - 20.03, y - 14.98)
    lines = outlines((off < 10) & (off > 4), GRID)
    assert len(lines) == 2
    for line, radius in zip(sorted(lines, key=len), (4, 10), strict=True):
        error = np.hypot(line[:, 0] - 20.03, line[:, 1] - 14.98) - radius
        assert np.abs(error).max() < 0.5 * GRID.pitch
        assert np.abs(np.mean(error)) < 0.1 * GRID.pitch


def test_a_slanted_edge_is_straight_to_a_third_of_a_pixel():
    x, y = centres()
    inside = (np.abs(0.96 * (x - 20) - 0.28 * (y - 15)) < 8) & (np.abs(y - 15) < 10)
    (line,) = outlines(inside, GRID)
    middle = line[np.abs(line[:, 1] - 15) < 8]
    off = np.abs(0.96 * (middle[:, 0] - 20) - 0.28 * (middle[:, 1] - 15)) - 8
    assert np.abs(off).max() < 0.33 * GRID.pitch


def test_a_figure_that_fills_the_grid_is_outlined_at_its_border():
    (line,) = outlines(np.ones((300, 400), bool), GRID)
    assert line.min(axis=0) == pytest.approx([0, 0], abs=0.05)
    assert line.max(axis=0) == pytest.approx([40, 30], abs=0.05)


def test_nothing_has_no_outline():
    assert outlines(np.zeros((300, 400), bool), GRID) == []


def test_every_pixel_is_on_its_side_or_within_half_a_pixel():
    # Blobs, with fingers and gaps one pixel wide.
    rng = np.random.default_rng(3)
    mask = ndimage.gaussian_filter(rng.normal(size=(300, 400)), 9) > 0.01
    mask[100:101, 150:260] = True
    mask[200:260, 300:301] = False
    mask[[0, -1]] = mask[:, [0, -1]] = False
    inside, rims = np.zeros_like(mask), []
    for line in outlines(mask, GRID):
        row, col = GRID.to_index(line[:, 0], line[:, 1])
        rim = np.stack([row - 0.5, col - 0.5], axis=1)
        inside ^= polygon2mask(mask.shape, rim)
        ahead = np.roll(rim, -1, axis=0)
        rims += [rim + t * (ahead - rim) for t in (0.0, 0.25, 0.5, 0.75)]
    wrong = np.argwhere(inside != mask)
    assert len(wrong) < 0.25 * np.count_nonzero(mask[1:] != mask[:-1])
    assert cKDTree(np.concatenate(rims)).query(wrong)[0].max() <= 0.5
