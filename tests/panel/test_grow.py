import numpy as np
import pytest

from relieffab.panel.deviate import deviations
from relieffab.panel.grow import grow


def over_nodes(faces, heights):
    """Triangles of node numbers as `deviations` takes them."""
    row, col = np.divmod(np.arange(heights.size), heights.shape[1])
    return np.stack([col, row, heights.ravel()], axis=1).astype(float), faces


@pytest.fixture
def rough():
    rng = np.random.default_rng(3)
    y, x = np.mgrid[0:60, 0:80] / 10
    wall = np.where(np.hypot(x - 4, y - 3) < 2, -3.0, 0.0)
    return wall + 0.2 * np.sin(2 * x) * np.cos(y) + 0.01 * rng.random(x.shape)


@pytest.mark.parametrize("bound", [0.3, 0.05, 0.005, 1e-4])
def test_no_triangle_is_out_of_bound_at_any_point(rough, bound):
    found = deviations(rough, *over_nodes(grow(rough, bound), rough)).max()
    assert 0.5 * bound < found <= bound * (1 + 1e-9) or bound < 0.001


def test_a_bound_of_nothing_is_the_relief_itself(rough):
    faces = grow(rough, 0.0)
    assert len(faces) == 2 * 59 * 79
    assert deviations(rough, *over_nodes(faces, rough)).max() < 1e-12


def test_finer_bounds_take_more_triangles(rough):
    counts = [len(grow(rough, bound)) for bound in (1.0, 0.1, 0.02, 0.005)]
    assert counts == sorted(counts)
    assert counts[0] < counts[-1] / 10


def test_a_plane_is_two_triangles():
    y, x = np.mgrid[0:30, 0:40]
    assert len(grow(0.25 * x - 0.5 * y, 1e-6)) == 2


def test_nodes_alone_do_not_tell_which_way_a_pixel_bends():
    h = np.zeros((2, 2))
    h[0, 1] = -1.0
    triangles = {frozenset(t) for t in grow(h, 0.01).tolist()}
    assert triangles == {frozenset((0, 1, 3)), frozenset((0, 3, 2))}


def test_the_face_stays_level_right_up_to_the_cut():
    """A dimple shallower than the bound in a wide face: no triangle leans into it from afar."""
    heights = np.zeros((60, 80))
    heights[30:33, 40:44] = -0.5
    heights[29:34, 39:45] = np.minimum(heights[29:34, 39:45], -0.01)
    faces = grow(heights, 0.02)
    z, (row, col) = heights.ravel()[faces], np.divmod(faces, 80)
    cut = (z < 0).any(axis=1)
    assert cut.any()
    assert row[cut].min() >= 28
    assert row[cut].max() <= 34
    assert col[cut].min() >= 38
    assert col[cut].max() <= 45
