from math import cos, pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.toolpath.envelope import Places, Terrain, tip_heights, tip_surface
from relieffab.toolpath.polar import bend_error

COMMON = {"flute_length": 20.0, "stepdown": 1.0, "feed": 500.0, "plunge": 100.0, "rpm": 1e4}
CUTTERS = {
    "flat": Cutter("flat", "flat", 3.0, **COMMON),
    "ball": Cutter("ball", "ball", 2.0, **COMMON),
    "bull": Cutter("bull", "bull", 3.0, corner_radius=0.5, **COMMON),
    "vee": Cutter("vee", "vee", 3.0, angle=60.0, tip_diameter=0.2, **COMMON),
    "tapered": Cutter("tapered", "tapered ball", 3.0, tip_diameter=1.0, angle=20.0, **COMMON),
}
PITCH = 0.25


def terrain_of(heights, radius, pitch=PITCH):
    heights = np.array(heights, float)
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    return Terrain.over(Grid(rows, cols, pitch, (0.0, rows * pitch)), heights, radius)


def brute(terrain, cutter, x, y, fine=12):
    """Least height of the tip, from the bent surface sampled `fine` times a pixel."""
    grid, r0 = terrain.grid, terrain.radius
    relief = Relief(grid, terrain.heights, np.ones(grid.shape, bool), -terrain.heights.min() + 1)
    u = np.linspace(-4, grid.cols * grid.pitch + 4, grid.cols * fine + 1)
    v = np.linspace(-4, grid.rows * grid.pitch + 4, grid.rows * fine + 1)
    u, v = np.meshgrid(u, v)
    r = r0 + relief.height_at(u, v)
    out = np.empty(len(x))
    for k, (cx, cy) in enumerate(zip(x, y, strict=True)):
        p = (v - cy) / r0
        away = np.hypot(u - cx, r * np.sin(p))
        out[k] = np.where(np.cos(p) > 0, r * np.cos(p) - r0 - cutter.profile(away), -np.inf).max()
    return out


@pytest.mark.parametrize("name", CUTTERS)
def test_every_cutter_rests_on_a_bare_column(name):
    terrain = terrain_of(np.zeros((41, 41)), 20.0)
    x, y = np.random.default_rng(1).uniform(2, 8, (2, 30))
    tips = tip_heights(terrain, CUTTERS[name], x, y)
    assert (tips >= -1e-9).all()
    assert tips.max() <= 2 * bend_error(terrain.heights, PITCH, 20.0) < 0.002


def test_a_ball_on_a_groove_along_the_axis():
    # A floor 2 mm deep over an angle of 4 / 20: its edges on the face stand where they do.
    heights = np.zeros((61, 41))
    heights[22:39] = -2.0
    terrain = terrain_of(heights, 20.0)
    ball = CUTTERS["ball"]
    assert tip_heights(terrain, ball, 5.0, 7.5) == pytest.approx(-2.0, abs=0.02)
    # Beside the wall the ball touches the corner on the face, at the angle p from its axis.
    for away in (0.3, 0.6, 0.9):
        y = (60 - 21) * PITCH - away
        p = away / 20.0
        aside = 20.0 * np.sin(p)
        rests = 20.0 * cos(p) - 20.0 - (1.0 - sqrt(1.0 - aside**2))
        found = float(tip_heights(terrain, ball, 5.0, y))
        assert rests - 1e-9 <= found <= rests + 0.05


def test_the_flat_picture_would_gouge_at_depth():
    heights = np.zeros((61, 41))
    heights[22:39] = -2.0
    round_one, flat = terrain_of(heights, 10.0), terrain_of(heights, 0.0)
    y = (60 - 22) * PITCH - np.linspace(0.9, 1.3, 9)
    x = np.full(9, 5.0)
    gap = tip_heights(round_one, CUTTERS["ball"], x, y) - tip_heights(flat, CUTTERS["ball"], x, y)
    assert gap.max() > 0.05


@settings(max_examples=25, deadline=None)
@given(
    arrays(np.float64, (9, 9), elements=st.floats(-2, 0, width=16)),
    st.sampled_from(sorted(CUTTERS)),
    st.sampled_from([8.0, 20.0, 60.0]),
)
def test_no_sample_of_the_bent_surface_is_cut(heights, name, radius):
    terrain = terrain_of(heights, radius)
    cutter = CUTTERS[name]
    x, y = np.random.default_rng(2).uniform(0.1, 1.9, (2, 12))
    found = tip_heights(terrain, cutter, x, y)
    exact = brute(terrain, cutter, x, y)
    assert (found >= exact - 1e-6).all()
    # Nor does it stay higher than the kept distance explains, and samples 0.03 mm apart on
    # slopes of 8 under a flank of 5.7: a rim jumps, so that it is not asked of the others.
    if name == "tapered":
        kept = bend_error(terrain.heights, PITCH, radius)
        assert (found - exact).max() <= 0.6 + 12 * kept


def test_rows_once_round_join():
    radius, count = 6.0, 120
    pitch = 2 * pi * radius / count
    v = np.arange(count + 1) / count * 2 * pi
    heights = -0.8 - 0.4 * np.cos(3 * v)[:, None] * np.ones((1, 31))
    terrain = terrain_of(heights, radius, pitch)
    x = np.full(count, 15 * pitch)
    y = np.arange(count) * pitch
    tips = tip_heights(terrain, CUTTERS["ball"], x, y)
    np.testing.assert_allclose(tips, np.roll(tips, count // 3), atol=1e-9)
    assert tips.max() < -0.3


def test_a_wall_across_the_gap_counts():
    # 30 degrees of face are left between the relief's last row and its first.
    radius, rows = 6.0, 110
    pitch = 2 * pi * radius / 120
    terrain = terrain_of(np.full((rows + 1, 31), -1.0), radius, pitch)
    tip = tip_heights(terrain, CUTTERS["ball"], 15 * pitch, rows * pitch + 0.001)
    assert 0.0 <= tip <= 2 * bend_error(terrain.heights, pitch, radius)


def test_lattices_of_places_are_points():
    terrain = terrain_of(np.full((21, 21), -1.0), 20.0)
    places = Places((1.0, 4.0), 0.0, 0.5, 0.5, 3, 4)
    found = tip_surface(terrain, CUTTERS["ball"], places)
    np.testing.assert_array_equal(found, tip_heights(terrain, CUTTERS["ball"], *places.xy()))
