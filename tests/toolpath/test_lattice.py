"""Rows of places against single points, and against dense sampling at random walls."""

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.toolpath.envelope import Places, Terrain, nodes, tip_heights, tip_surface

GRID = Grid(19, 23, 0.2, (1.0, 5.0))


def field(kind, rng):
    if kind == "walls":
        return np.where(rng.random(GRID.node_shape) < 0.6, -2.0, 0.0)
    if kind == "smooth":
        x, y = np.meshgrid(*GRID.node_axes())
        return -0.8 + 0.5 * np.sin(2 * x + 3 * rng.random()) * np.cos(y + 3 * rng.random())
    return -2.0 * rng.random(GRID.node_shape)


@pytest.mark.parametrize("angle", [0.0, 90.0, -37.0, 161.0])
@pytest.mark.parametrize("kind", ["rough", "walls", "smooth"])
def test_rows_are_the_points_of_the_other_kernel(every_cutter, kind, angle):
    rng = np.random.default_rng(11)
    terrain = Terrain.over(GRID, field(kind, rng))
    places = Places((rng.uniform(0, 6), rng.uniform(0, 6)), angle, 0.13, 0.17, 25, 31)
    for allowance in (0.0, 0.003, 0.12):
        fast = tip_surface(terrain, every_cutter, places, allowance=allowance)
        slow = tip_heights(terrain, every_cutter, *places.xy(), allowance=allowance)
        assert np.allclose(fast, slow, atol=1e-7)


SMALL = Grid(6, 7, 0.3, (0.0, 1.8))
FINE = np.arange(-1.0, 8.01, 0.25)


@settings(max_examples=25, deadline=None)
@given(
    heights=arrays(float, SMALL.node_shape, elements=st.sampled_from([0.0, -0.4, -1.1, -2.0])),
    noise=st.integers(0, 2**32 - 1),
)
def test_no_place_gouges_at_four_times_the_resolution(every_cutter, heights, noise):
    """Walls a pixel wide, plateaus, single posts and pits: whatever is drawn."""
    rng = np.random.default_rng(noise)
    if noise % 2:
        heights = np.clip(heights + 0.05 * rng.standard_normal(heights.shape), -2.0, 0.0)
    relief = Relief(SMALL, heights, np.ones(SMALL.shape, bool), 2.0)
    places = Places((-0.1, rng.uniform(1.7, 1.9)), rng.uniform(-20, 20), 0.11, 0.13, 12, 18)
    tips = tip_surface(Terrain.of(relief), every_cutter, places)
    sx, sy = SMALL.to_xy(*np.meshgrid(FINE, FINE, indexing="ij"))
    surface = relief.height_at(sx, sy)
    x, y = places.xy()
    away = np.hypot(sx.ravel() - x[..., None], sy.ravel() - y[..., None])
    gouge = surface.ravel() - tips[..., None] - every_cutter.profile(away)
    assert gouge.max() < 1e-9


def test_places_turn_from_x_towards_y():
    x, y = Places((1.0, 2.0), 90.0, 0.5, 0.25, 2, 3).xy()
    assert np.allclose(x, [[1, 1, 1], [1.25, 1.25, 1.25]])
    assert np.allclose(y, [[2, 2.5, 3], [2, 2.5, 3]])
    x, y = nodes(GRID).xy()
    assert np.allclose(x, np.meshgrid(*GRID.node_axes())[0])
    assert np.allclose(y, np.meshgrid(*GRID.node_axes())[1])


def test_the_answer_does_not_depend_on_the_number_of_threads(cutters):
    terrain = Terrain.over(GRID, field("rough", np.random.default_rng(8)))
    places = Places((0.5, 5.5), 10.0, 0.02, 0.02, 300, 300)
    many = tip_surface(terrain, cutters["ball"], places)
    threads = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        one = tip_surface(terrain, cutters["ball"], places)
    finally:
        numba.set_num_threads(threads)
    assert np.array_equal(one, many)
