"""The compiled drop-cutter against dense sampling and against plane geometry."""

import math
from dataclasses import replace

import numba
import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.toolpath.envelope import Places, Terrain, tip_heights, tip_surface

GRID = Grid(9, 11, 0.4, (1.0, 5.0))
DEPTH = 2.0


def relief_of(heights, grid=GRID):
    return Relief(grid, np.asarray(heights, float), np.ones(grid.shape, bool), 10.0)


def random_heights(kind, rng):
    smooth = -DEPTH * rng.random(GRID.node_shape)
    if kind == "walls":
        return np.where(rng.random(GRID.node_shape) < 0.6, -DEPTH, 0.0)
    return smooth if kind == "rough" else 0.1 * smooth


def sampled_tip_heights(relief, cutter, x, y):
    """Slow twin: the largest gap over dense samples of the surface, then denser ones around it."""
    rows, cols = relief.grid.shape
    at, along = np.arange(-2, rows + 2.01, 1 / 16), np.arange(-2, cols + 2.01, 1 / 16)
    sx, sy = relief.grid.to_xy(*np.meshgrid(at, along, indexing="ij"))
    sz = relief.height_at(sx, sy)
    best = []
    for a, b in zip(x, y, strict=True):
        px, py, pz, spacing = sx, sy, sz, relief.grid.pitch / 16
        tip = -np.inf
        for _ in range(4):
            gap = pz - cutter.profile(np.hypot(px - a, py - b))
            k = np.unravel_index(gap.argmax(), gap.shape)
            tip = max(tip, gap[k])
            near = np.linspace(-1.5, 1.5, 25) * spacing
            px, py = np.meshgrid(px[k] + near, py[k] + near)
            pz, spacing = relief.height_at(px, py), spacing / 8
        best.append(tip)
    return np.array(best)


@pytest.mark.parametrize("kind", ["rough", "walls", "gentle"])
def test_never_below_a_sampled_twin_and_close_above_it(every_cutter, kind):
    rng = np.random.default_rng(3)
    relief = relief_of(random_heights(kind, rng))
    x, y = rng.uniform(0.6, 5.8, 40), rng.uniform(1.0, 5.4, 40)
    fast = tip_heights(Terrain.of(relief), every_cutter, x, y)
    gap = fast - sampled_tip_heights(relief, every_cutter, x, y)
    assert gap.min() > -1e-9
    assert np.quantile(gap, 0.9) < 0.001
    assert gap.max() < 0.1


def slope_relief(tangent):
    """A plane that falls along X, on a grid much wider than any cutter."""
    grid = Grid(40, 40, 0.3, (0.0, 12.0))
    x, _ = grid.node_axes()
    return relief_of(np.tile(-tangent * x, (41, 1)), grid)


@pytest.mark.parametrize("tangent", [0.1, 0.3, 0.7])
def test_ball_on_a_slope_touches_square_to_it(tangent, cutters):
    relief, x = slope_relief(tangent), 6.05
    ball = cutters["ball"]
    lifted = ball.radius * (math.hypot(1, tangent) - 1)
    found = tip_heights(Terrain.of(relief), ball, x, 6.13)
    assert found == pytest.approx(-tangent * x + lifted, abs=1e-9)


@pytest.mark.parametrize("tangent", [0.1, 0.7])
def test_flat_on_a_slope_rests_on_its_rim(tangent, cutters):
    found = tip_heights(Terrain.of(slope_relief(tangent)), cutters["flat"], 6.05, 6.13)
    assert found == pytest.approx(-tangent * (6.05 - 0.75), abs=1e-9)


def test_bull_on_a_slope_touches_with_its_arc(cutters):
    tangent, bull = 0.5, cutters["bull"]
    found = tip_heights(Terrain.of(slope_relief(tangent)), bull, 6.05, 6.13)
    lifted = bull.flat_radius * tangent + 0.3 * (math.hypot(1, tangent) - 1)
    assert found == pytest.approx(-tangent * 6.05 + lifted, abs=1e-9)


def groove_relief():
    """A straight groove along Y, its sides falling at 45 degrees to a depth of 1.2 mm."""
    grid = Grid(40, 40, 0.3, (0.0, 12.0))
    x, _ = grid.node_axes()
    return relief_of(np.tile(np.minimum(np.abs(x - 6.0) - 1.2, 0.0), (41, 1)), grid)


def test_vee_in_a_groove_of_its_own_angle_reaches_the_bottom(cutters):
    found = tip_heights(Terrain.of(groove_relief()), cutters["sharp vee"], 6.0, 6.13)
    assert found == pytest.approx(-1.2, abs=1e-9)


def test_blunt_cutters_in_a_groove_rest_on_its_sides(cutters):
    terrain = Terrain.of(groove_relief())
    ball = tip_heights(terrain, cutters["ball"], 6.0, 6.13)
    assert ball == pytest.approx(-1.2 + 0.75 * (math.sqrt(2) - 1), abs=1e-9)
    flat = tip_heights(terrain, cutters["flat"], 6.0, 6.13)
    assert flat == pytest.approx(-1.2 + 0.75, abs=1e-9)


def wall_relief():
    """The face left of X 6, then a wall one pixel wide down to -2."""
    grid = Grid(40, 40, 0.3, (0.0, 12.0))
    x, _ = grid.node_axes()
    return relief_of(np.tile(np.where(x < 6.15, 0.0, -2.0), (41, 1)), grid)


@pytest.mark.parametrize("away", [0.749, 0.75, 0.751, 1.1])
def test_flat_beside_a_wall_clears_it_by_its_radius_and_no_less(away, cutters):
    found = tip_heights(Terrain.of(wall_relief()), cutters["flat"], 6.0 + away, 6.13)
    if away <= 0.75:
        assert found == 0.0
    else:
        foot = -2.0 * (away - 0.75) / 0.3
        assert found == pytest.approx(max(foot, -2.0), abs=1e-9)


def test_tapered_ball_beside_a_wall_rests_on_the_walls_edge(cutters):
    cutter = cutters["tapered ball"]
    found = tip_heights(Terrain.of(wall_relief()), cutter, 6.45, 6.13)
    assert found == pytest.approx(-float(cutter.profile(0.45)), abs=1e-9)


def test_allowance_is_kept_in_every_direction(every_cutter):
    """Grown by its allowance, a cutter still clears the surface by that distance."""
    rng = np.random.default_rng(5)
    relief = relief_of(random_heights("rough", rng))
    cutter, allowance = every_cutter, 0.12
    terrain = Terrain.of(relief)
    z = tip_heights(terrain, cutter, 3.1, 3.4, allowance=allowance)
    for angle in np.linspace(0, 2 * np.pi, 16, endpoint=False):
        dx, dy = 0.999 * allowance * np.cos(angle), 0.999 * allowance * np.sin(angle)
        assert tip_heights(terrain, cutter, 3.1 + dx, 3.4 + dy) <= z + 1e-9
    assert tip_heights(terrain, cutter, 3.1, 3.4) <= z - allowance + 1e-9


def test_the_shank_clears_a_wall_that_the_flutes_would_pass(cutters):
    flutes = {"diameter": 0.6, "flute_length": 1.5, "shank_diameter": 2.0}
    cutter = replace(cutters["flat"], **flutes)
    places = Places((6.2, 6.13), 0.0, 0.05, 1.0, 1, 40)
    x, y = (axis.ravel() for axis in places.xy())
    found = tip_heights(Terrain.of(wall_relief()), cutter, x, y)

    def wall(s):
        return np.clip(-2.0 * (s - 6.0) / 0.3, -2.0, 0.0)

    assert np.allclose(found, np.maximum(wall(x - 0.3), wall(x - 1.0) - 1.5), atol=1e-9)
    assert (found == -1.5).sum() > 5
    assert np.allclose(tip_surface(Terrain.of(wall_relief()), cutter, places)[0], found, atol=1e-9)


def test_the_face_goes_on_beyond_the_grid(cutters):
    terrain = Terrain.of(relief_of(np.full(GRID.node_shape, -DEPTH)))
    assert tip_heights(terrain, cutters["ball"], [0.5, 1.0, 9.0], [3.0, 3.0, 9.0]).tolist() == [
        0,
        0,
        0,
    ]
    near = tip_heights(terrain, cutters["ball"], 1.3, 3.0)
    assert near == pytest.approx(-float(cutters["ball"].profile(0.3)), abs=1e-12)


def test_the_answer_does_not_depend_on_the_number_of_threads(cutters):
    rng = np.random.default_rng(8)
    terrain = Terrain.of(relief_of(random_heights("rough", rng)))
    x, y = rng.uniform(0.6, 5.8, 3000), rng.uniform(1.0, 5.4, 3000)
    many = tip_heights(terrain, cutters["ball"], x, y)
    threads = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        one = tip_heights(terrain, cutters["ball"], x, y)
    finally:
        numba.set_num_threads(threads)
    assert np.array_equal(one, many)


def test_inputs_stay_as_they_were(cutters):
    heights = random_heights("rough", np.random.default_rng(2))
    kept, x = heights.copy(), np.array([2.0, 3.0])
    tip_heights(Terrain.over(GRID, heights), cutters["ball"], x, np.array([3.0, 3.0]))
    assert np.array_equal(heights, kept)
    assert x.tolist() == [2, 3]


def test_a_part_is_the_whole_where_no_cutter_reaches_over_its_edge(cutters):
    rng = np.random.default_rng(5)
    grid = Grid(40, 60, 0.2, (1.0, 9.0))
    whole = Terrain.over(grid, -DEPTH * rng.random(grid.node_shape))
    part = whole.within((4.0, 3.0), (7.05, 6.0), 1.0)
    assert part.heights.size < whole.heights.size / 2
    x, y = rng.uniform(4.0, 7.05, 300), rng.uniform(3.0, 6.0, 300)
    for cutter in cutters.values():
        assert np.allclose(
            tip_heights(part, cutter, x, y), tip_heights(whole, cutter, x, y), rtol=0, atol=1e-9
        )
    assert whole.within((0.0, 0.0), (20.0, 20.0), 1.0).grid == grid
