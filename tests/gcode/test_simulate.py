"""Grooves whose shape is known, and a slow twin that samples every move densely."""

from dataclasses import replace
from itertools import pairwise

import numba
import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.program import Program
from relieffab.gcode.simulate import simulate
from relieffab.gcode.slab import lattice
from relieffab.grid import Grid
from relieffab.stock import Stock


def cutter(shape, **size):
    sizes = {"diameter": 3.0} | size
    return Cutter(shape, shape, flute_length=9.0, stepdown=1, feed=1, plunge=1, rpm=1, **sizes)


CUTTERS = [
    cutter("flat"),
    cutter("ball"),
    cutter("bull", corner_radius=0.6),
    cutter("vee", angle=60.0),
    cutter("vee", angle=30.0, tip_diameter=0.4),
    cutter("tapered ball", angle=20.0, tip_diameter=1.0),
    cutter("tapered ball", angle=90.0, tip_diameter=1.4),
    cutter("form", points=((0.0, 0.0), (0.3, 0.0), (0.7, 0.2), (1.2, 0.9), (1.5, 2.5))),
    cutter("form", points=((0.0, 0.0), (0.5, 0.3), (1.5, 1.6))),
]
GRID = Grid(40, 60, 0.25, (2.0, 12.0))
STOCK = Stock(20.0, 15.0, 10.0)


def program(points, rapid=(), name="job.nc"):
    count = len(points)
    feed = np.full(count, 100.0)
    feed[list(rapid)] = np.inf
    return Program(
        name,
        np.array(points, float),
        feed,
        np.arange(1, count + 1),
        np.ones(count),
        np.zeros(count + 1),
        count,
        np.ones(count, np.int64),
        np.zeros(count, np.int64),
    )


def carve(points, tool, stock=STOCK, **options):
    return simulate([program(points)], [tool], GRID, stock, **options)


def nodes(grid):
    return np.meshgrid(*grid.node_axes())


def twin(points, tool, grid, samples=3001):
    """Sample each move densely: never below the truth, and above it by a step's worth."""
    x, y = nodes(grid)
    height = np.zeros(x.shape)
    for a, b in pairwise(points):
        for t in np.linspace(0, 1, samples):
            px, py, pz = np.asarray(a) + t * (np.asarray(b) - a)
            height = np.minimum(height, pz + tool.profile(np.hypot(x - px, y - py)))
    return height


@pytest.mark.parametrize("tool", CUTTERS)
def test_against_the_twin(tool):
    rng = np.random.default_rng(3)
    points = rng.uniform([3, 3, -3], [8, 11, 0.5], (5, 3))
    points[3, :2] = points[2, :2]  # a plunge
    points[4, :2] = points[3, :2] + [0.02, 0.01]  # nearly one
    grid = Grid(22, 20, 0.5, (1.2, 12.3))
    left = simulate([program(points)], [tool], grid, Stock(12.0, 15.0, 9.0), refine=1)
    want = twin(points, tool, left.grid)
    difference = want - left.heights
    # A node on the rim at one instant only may escape the samples.
    assert difference.min() > -1e-6
    assert np.quantile(difference, 0.97) < 0.004
    assert (left.heights < -0.1).sum() > 8


@pytest.mark.parametrize("refine", [1, 2, 3])
def test_a_ball_leaves_a_round_groove(refine):
    left = carve([[4, 6, -1], [14, 6, -1]], CUTTERS[1], refine=refine)
    x, y = nodes(left.grid)
    off = np.abs(y - 6)
    want = np.where(off <= 1.5, -1 + 1.5 - np.sqrt(np.maximum(1.5**2 - off**2, 0)), 0)
    middle = (x > 4) & (x < 14)
    assert np.allclose(left.heights[middle], np.minimum(want, 0)[middle], atol=1e-6)


def test_a_vee_leaves_a_vee():
    left = carve([[4, 6, -1], [14, 6, -1]], CUTTERS[3])
    x, y = nodes(left.grid)
    middle = (x > 4) & (x < 14)
    want = np.minimum(-1 + np.abs(y - 6) * np.sqrt(3), 0)
    assert np.allclose(left.heights[middle], want[middle], atol=1e-6)


def test_a_flat_plunge_leaves_a_hole():
    left = carve([[7, 6, 5], [7, 6, -2]], CUTTERS[0])
    x, y = nodes(left.grid)
    r = np.hypot(x - 7, y - 6)
    assert (left.heights[r <= 1.5] == -2).all()
    assert (left.heights[r > 1.5 + 1e-6] == 0).all()


def test_a_ball_on_a_ramp_cuts_below_its_tip():
    slope = 0.3
    left = carve([[4, 6, 0], [14, 6, -3]], CUTTERS[1])
    x, y = nodes(left.grid)
    line = (np.abs(y - 6) < 1e-9) & (x > 6) & (x < 12)
    want = -slope * (x - 4) + 1.5 - 1.5 * np.sqrt(1 + slope**2)
    assert np.allclose(left.heights[line], want[line], atol=1e-6)


def test_a_steep_ramp_of_a_cone_is_cut_by_its_rim():
    left = carve([[4, 6, 4], [9, 6, -6]], cutter("vee", angle=120.0))
    x, y = nodes(left.grid)
    line = (np.abs(y - 6) < 1e-9) & (x > 6) & (x < 7)
    want = 4 - 2 * (x - 4 + 1.5) + 1.5 / np.sqrt(3)
    assert np.allclose(left.heights[line], np.minimum(want, 0)[line], atol=1e-6)


def test_the_answer_does_not_depend_on_threads():
    rng = np.random.default_rng(5)
    points = rng.uniform([2, 2, -3], [16, 12, 1], (300, 3))
    before = numba.get_num_threads()
    try:
        numba.set_num_threads(1)
        one = carve(points, CUTTERS[2], refine=4)
    finally:
        numba.set_num_threads(before)
    assert np.array_equal(one.heights, carve(points, CUTTERS[2], refine=4).heights)


def test_chunks_join_without_a_seam(monkeypatch):
    rng = np.random.default_rng(6)
    points = rng.uniform([2, 2, -3], [16, 12, 1], (40, 3))
    whole = carve(points, CUTTERS[1])
    told = []
    monkeypatch.setattr("relieffab.gcode.slab.CHUNK", 7)
    parts = carve(points, CUTTERS[1], progress=lambda *words: told.append(words))
    assert np.array_equal(whole.heights, parts.heights)
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert told[-1] == ("carving", pytest.approx(length), pytest.approx(length), "mm")
    assert len(told) == 6


def test_programs_follow_one_another_from_one_work_zero():
    stock = Stock(20.0, 15.0, 10.0, work_zero=(10.0, 7.0, 0.0))
    runs = [program([[0, 0, -1], [2, 0, -1]]), program([[0, 0, -0.5], [0, 2, -2]])]
    left = simulate(runs, [CUTTERS[1], CUTTERS[3]], GRID, stock)
    one = carve([[10, 7, -1], [12, 7, -1]], CUTTERS[1])
    two = carve([[10, 7, -0.5], [10, 9, -2]], CUTTERS[3])
    assert np.array_equal(left.heights, np.minimum(one.heights, two.heights))


def test_a_rapid_through_material_is_told_where():
    points = [[4, 6, 5], [4, 6, -1], [4, 6, 5], [14, 6, 5], [14, 6, -2], [5, 6, -2]]
    run = program(points, rapid=[0, 2, 3, 5])
    (text,) = simulate([run], [CUTTERS[0]], GRID, STOCK).crashes
    assert text == "job.nc line 6: a rapid goes through 2.000 mm of material"


def test_rapids_in_the_air_and_in_a_cut_groove_bite_nothing():
    points = [[4, 6, 0], [4, 6, -2], [14, 6, -2], [4, 6, -2], [4, 6, 5]]
    assert simulate([program(points, rapid=[0, 3, 4])], [CUTTERS[0]], GRID, STOCK).crashes == ()


def test_the_lattice_holds_cuts_beyond_the_relief_but_not_beyond_the_stock():
    assert carve([[5, 6, -1], [8, 6, -1]], CUTTERS[0]).grid == Grid(80, 120, 0.125, (2.0, 12.0))
    left = carve([[0.5, 6, -1], [8, 14.9, -1], [8, 14.9, 9], [99, 14, 9]], CUTTERS[0])
    x, y = left.grid.node_axes()
    assert x[0] <= 0 < x[8] and y[0] >= 15 > y[8] and x[-1] == pytest.approx(17)
    hole = np.hypot(*np.meshgrid(x - 0.5, y - 6)) < 1.5
    assert (left.heights[hole] == -1).all()


def test_a_lattice_keeps_the_relief_nodes():
    fine = lattice(GRID, 3, np.array([[0.9, 1.0], [18.0, 13.0]]))
    row, col = fine.to_index(*GRID.to_xy(0.0, 0.0))
    assert (row % 3, col % 3) == pytest.approx((0, 0), abs=1e-9)
    assert fine.pitch * 3 == GRID.pitch


def test_bad_use():
    with pytest.raises(InputError, match="needs its cutter"):
        simulate([program([[0, 0, 1]])], [], GRID, STOCK)
    with pytest.raises(InputError, match="coarser"):
        carve([[5, 6, -1], [8, 6, -1]], CUTTERS[0], refine=0)


def test_a_shank_wider_than_the_flutes_rubs_where_it_goes_below_what_stands():
    stub = cutter("flat", diameter=1.0, shank_diameter=3.0)
    stub = replace(stub, flute_length=2.0)
    deep = [[5, 8, 1], [5, 8, -2.5], [9, 8, -2.5], [9, 8, 1]]
    (text,) = simulate([program(deep)], [stub], GRID, STOCK).crashes
    assert "job.nc line 2: the shank of flat rubs through 0.500 mm" in text
    shallow = np.array(deep) * [1, 1, 0.8]
    assert simulate([program(shallow)], [stub], GRID, STOCK).crashes == ()
    # A pocket as wide as the shank takes it.
    wide = cutter("flat", diameter=5.0)
    runs = [program([[4, 8, 1], [4, 8, -1], [10, 8, -1], [10, 8, 1]]), program(deep)]
    assert simulate(runs, [wide, stub], GRID, STOCK).crashes == ()
