import manifold3d
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.grid import Grid
from relieffab.panel.edges import outline
from relieffab.panel.sinking import sink
from relieffab.panel.space import clear_of_face, part_touching, solid_above
from relieffab.panel.triangulate import triangulate
from relieffab.relief.model import Relief
from relieffab.stock import Stock

HEIGHTS = st.one_of(st.just(0.0), st.sampled_from([-0.5, -1.0, -1e-5]), st.floats(-2, 0, width=16))


def surface_of(heights):
    heights = np.array(heights, float)
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    grid = Grid(rows, cols, 1.0, (5.0, 5.0 + rows))
    relief = Relief(grid, heights, np.ones((rows, cols), bool), 2.0)
    return triangulate(sink(relief, Stock(100, 100, 10)), 0.0)


def space_below(heights, pitch=1.0):
    """Volume between the face and the relief: a prism a triangle."""
    h = np.asarray(heights)
    a, b, c, d = h[:-1, :-1], h[:-1, 1:], h[1:, :-1], h[1:, 1:]
    return -((a + c + d) / 6 + (a + b + d) / 6).sum() * pitch**2


def assert_solid(surface, heights, gap=1e-6):
    surface = part_touching(clear_of_face(surface, gap), gap)
    vertices, faces = solid_above(surface)
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    lid = surface.points()[surface.faces][:, :, :2]
    u, v = lid[:, 1] - lid[:, 0], lid[:, 2] - lid[:, 0]
    area = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum() / 2
    assert mesh.volume == pytest.approx(area + space_below(heights), abs=1e-3)
    solid = manifold3d.Manifold(manifold3d.Mesh64(vertices, faces.astype(np.uint64)))
    assert solid.status() == manifold3d.Error.NoError


@settings(max_examples=60, deadline=None, derandomize=True)
@given(arrays(float, st.tuples(st.integers(2, 9), st.integers(2, 9)), elements=HEIGHTS))
def test_any_relief_closes_to_a_solid(heights):
    surface = surface_of(heights)
    if (heights < -1e-6).any():
        assert_solid(surface, heights)


@pytest.mark.parametrize(("other", "touching"), [((4, 4), 1), ((2, 4), 1), ((4, 5), 0)])
def test_figures_that_touch_at_a_node_are_parted(other, touching):
    h = np.zeros((8, 8))
    h[2, 2] = h[other] = -1.0
    surface = surface_of(h)
    assert len(surface.vertices) == 14 - touching
    parted = part_touching(surface, 1e-3)
    assert len(parted.vertices) == 14
    gaps = np.linalg.norm(parted.points()[:, None] - parted.points(), axis=2)
    assert gaps[gaps > 0].min() == pytest.approx(2e-3 if touching else 1.0)
    assert_solid(surface, h)


def test_islands_and_holes_and_peaks_on_the_face():
    h = np.full((14, 14), -1.0)
    h[0] = h[-1] = h[:, 0] = h[:, -1] = 0.0
    h[4:8, 4:8] = 0.0  # an island
    h[5, 5] = -0.5  # a pit in it
    h[10, 10] = 0.0  # a peak that just reaches the face
    h[10, 3:6] = 0.0  # a ridge along it
    surface = surface_of(h)
    assert_solid(surface, h)


def test_a_peak_and_a_ridge_are_lowered():
    h = np.full((5, 7), -1.0)
    h[2, 3] = 0.0  # a peak
    h[:3, 5] = 0.0  # a ridge from the grid's border inwards
    surface = surface_of(h)
    cleared = clear_of_face(surface, 1e-3)
    on_face = set(np.flatnonzero(cleared.vertices[:, 2] == 0).tolist())
    assert on_face <= set(outline(cleared.faces).ravel().tolist())
    top = cleared.vertices[cleared.vertices[:, 2] > -0.5]
    assert (top[:, 2] == 0).sum() == 1
    assert (top[:, 2] == -1e-3).sum() == len(top) - 1 >= 2


def test_a_ridge_between_two_outlines_is_split():
    h = np.zeros((4, 4))
    h[1, 2] = h[2, 1] = -1.5
    surface = surface_of(h)
    cleared = clear_of_face(surface, 1e-3)
    assert len(cleared.faces) == len(surface.faces) + 2
    assert cleared.vertices[-1].tolist() == [1.5, -1.5, -1e-3]


def test_what_lies_on_the_face_is_left_out():
    h = np.full((4, 4), -1e-4)
    surface = surface_of(h)
    assert len(clear_of_face(surface, 1e-3).faces) == 0
