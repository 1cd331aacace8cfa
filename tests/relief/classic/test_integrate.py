import numpy as np
import pytest

from relieffab.relief.classic.integrate import TWIST, integrate
from relieffab.relief.model import nodes_of, pixel_slopes

PITCH = 0.25


def blob(rows, cols):
    """A figure with a hole, a thin leg and a part that hangs by one corner."""
    i, j = np.indices((rows, cols))
    mask = (i - rows / 2) ** 2 + (j - cols / 2) ** 2 < (0.4 * rows) ** 2
    mask &= (i - rows / 2) ** 2 + (j - cols / 2) ** 2 > (0.1 * rows) ** 2
    mask[rows // 2 : rows - 4, 6:8] = True
    mask[rows // 2 : rows // 2 + 2, 6 : cols // 2 - rows // 5] = True
    return mask


def waves(shape):
    i, j = np.indices((shape[0] + 1, shape[1] + 1)) * PITCH
    return np.sin(0.3 * j) * np.cos(0.2 * i) + 0.05 * j


@pytest.mark.parametrize("least", [1.0, 0.2])
def test_the_slopes_of_a_surface_give_its_heights(least):
    mask = blob(90, 110)
    h = waves(mask.shape)
    weight = np.random.default_rng(0).uniform(least, 1.0, mask.shape)
    nodes = nodes_of(mask)
    found = integrate(pixel_slopes(h, PITCH), weight, mask, PITCH, tolerance=1e-7)
    np.testing.assert_allclose(found[nodes], (h - h[nodes].mean())[nodes], atol=1e-4)
    assert (found[~nodes] == 0).all()


def test_a_plane_comes_back_up_to_the_edge():
    mask = blob(60, 70)
    i, j = np.indices((61, 71)) * PITCH
    slopes = np.stack([np.full(mask.shape, 0.3), np.full(mask.shape, -0.2)])
    found = integrate(slopes, np.ones(mask.shape), mask, PITCH, tolerance=1e-7)
    plane = 0.3 * j + 0.2 * i
    nodes = nodes_of(mask)
    np.testing.assert_allclose(found[nodes], (plane - plane[nodes].mean())[nodes], atol=1e-4)


def test_the_least_squares_agree_with_a_dense_solution():
    rng = np.random.default_rng(1)
    mask = np.zeros((12, 14), bool)
    mask[3:9, 3:11] = True
    mask[3:5, 3:6] = False
    asked, weight = rng.normal(size=(2, 12, 14)), rng.uniform(0.2, 1.0, (12, 14))
    found = integrate(asked, weight, mask, PITCH, tolerance=1e-9)
    nodes = np.argwhere(nodes_of(mask))
    index = {tuple(node): k for k, node in enumerate(nodes)}
    rows, right = [], []
    for i, j in np.argwhere(mask):
        corners = [index[i, j], index[i, j + 1], index[i + 1, j], index[i + 1, j + 1]]
        w = np.float32(weight[i, j])
        for signs, want, share in (
            ((-1, 1, -1, 1), asked[0, i, j], w),
            ((1, 1, -1, -1), asked[1, i, j], w),
            ((1, -1, -1, 1), 0.0, TWIST),
        ):
            row = np.zeros(len(nodes))
            row[corners] = signs
            root = np.sqrt(share)
            rows.append(root * row / (2 * PITCH))
            right.append(root * want)
    dense = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
    np.testing.assert_allclose(found[tuple(nodes.T)], dense - dense.mean(), atol=1e-6)


def test_slopes_without_weight_are_not_followed():
    mask = np.zeros((40, 60), bool)
    mask[5:35, 5:55] = True
    slopes = np.zeros((2, *mask.shape))
    slopes[0, 5:35, 29:31] = 8.0
    weight = np.where(slopes[0] > 0, 0.0, 1.0)
    kept = np.ptp(integrate(slopes, np.ones(mask.shape), mask, PITCH))
    dropped = np.ptp(integrate(slopes * weight, weight, mask, PITCH))
    assert dropped < 1e-6 < 3.0 < kept


def test_parts_that_do_not_touch_are_found_alike():
    mask = np.zeros((30, 60), bool)
    mask[5:25, 5:25] = mask[5:25, 35:55] = True
    slopes = np.full((2, *mask.shape), 0.5)
    found = integrate(slopes, np.ones(mask.shape), mask, PITCH, tolerance=1e-7)
    np.testing.assert_allclose(found[5:26, 5:26], found[5:26, 35:56], atol=1e-4)


def test_nothing_asked_gives_nothing():
    mask = blob(40, 50)
    assert not integrate(np.zeros((2, 40, 50)), np.ones(mask.shape), mask, PITCH).any()


def test_no_checkerboard_is_left():
    mask = blob(60, 70)
    slopes = np.random.default_rng(2).normal(size=(2, *mask.shape))
    found = integrate(slopes, np.ones(mask.shape), mask, PITCH)
    board = 1 - 2 * (np.indices(found.shape).sum(axis=0) % 2)
    assert abs((found * board).sum()) < 0.05 * np.abs(found).sum()


def test_nodes_touch_the_figure():
    mask = np.zeros((3, 3), bool)
    mask[1, 1] = True
    nodes = nodes_of(mask)
    assert nodes.sum() == 4
    assert nodes[1:3, 1:3].all()
