"""Bites of known cuts, and limits that no toolpath and no option gets round."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.cutter import Cutter
from relieffab.errors import FindingsError
from relieffab.fittings import PLACES
from relieffab.gcode.dialect import DIALECTS
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

GRID = Grid(20, 30, 0.5, (0.0, 10.0))
TRAVEL, RATE = (200.0,) * 3, (2000.0,) * 3


def cutter(stepdown=1.0, flute=4.0, shape="flat", diameter=2.0):
    return Cutter("c", shape, diameter, flute, stepdown, 800.0, 300.0, 8000.0)


def test_bites_are_what_is_taken_from_what_still_stands():
    slab = Slab.whole(GRID, Stock(15.0, 10.0, 6.0))
    path = [[3, 5, 2], [3, 5, -1], [9, 5, -1], [9, 5, -1.5], [3, 5, -1.5], [3, 5, 2], [3, 5, -1.5]]
    bites = slab.cut(np.array(path, float), cutter())
    assert bites == pytest.approx([0, 1, 1, 0.5, 0.5, 0, 0], abs=1e-6)
    assert slab.heights.min() == -1.5 and slab.heights.dtype == np.float32


def test_a_copy_is_cut_alone():
    slab = Slab.whole(GRID, Stock(15.0, 10.0, 6.0))
    slab.copy().cut(np.array([[3, 5, 2], [3, 5, -1]], float), cutter())
    assert not slab.heights.any()


def twin_bites(points, tool):
    """Deepest bite of each move, by standing the cutter at many places along it."""
    x, y = np.meshgrid(*GRID.node_axes())
    left, bites = np.zeros(x.shape), [0.0]
    for a, b in pairwise(points):
        before = left.copy()
        for t in np.linspace(0, 1, 120):
            px, py, pz = a + t * (b - a)
            left = np.minimum(left, pz + tool.profile(np.hypot(x - px, y - py)))
        bites.append((before - left).max())
    return np.array(bites)


coordinates = st.tuples(st.floats(0.5, 14.5), st.floats(0.5, 9.5), st.floats(-4.5, 1.0))


@settings(max_examples=150, deadline=None)
@given(
    st.lists(coordinates, min_size=1, max_size=5),
    st.sampled_from([0.4, 1.0, 3.0, 9.0]),
    st.sampled_from([1.5, 3.0, 9.0]),
    st.sampled_from([1.0, 2.5, 5.0]),
    st.sampled_from(["flat", "ball"]),
    st.sampled_from([0.1, 1.0]),
    st.sampled_from(sorted(DIALECTS)),
    st.sampled_from(["mm", "in"]),
    st.tuples(st.sampled_from(sorted(PLACES)), st.sampled_from(["top", "bottom"])),
)
def test_nothing_gets_round_the_limits(
    places, stepdown, flute, depth, shape, factor, dialect, units, zero
):
    tool, stock = cutter(stepdown, flute, shape), Stock.zeroed((15.0, 10.0, 4.0), *zero)
    machine = Machine("m", "", TRAVEL, RATE, (30.0,) * 3, (0.0, 1e4), 1e4, dialect=dialect)
    material = Material("w", "W", 1.0, factor)
    setup = Setup(machine, material, stock, depth, "mm" if dialect == "marlin" else units)
    points = np.array([[*places[0][:2], 5.0], *places, [*places[-1][:2], 5.0]])
    feed = np.array([np.inf, *[200.0] * len(places), np.inf])
    slab = Slab.whole(GRID, stock)
    lowest, deepest = points[:, 2].min(), twin_bites(points, tool).max()
    bound = min(depth, flute, stock.thickness)
    allowed = 1.1 * stepdown * factor + 0.01
    try:
        text = write_program(Toolpath("finish", points, feed, tool, 8000.0), setup, slab)
    except FindingsError:
        assert lowest < -bound or deepest > allowed - 0.005
        assert not slab.heights.any()
        return
    assert lowest >= -bound - 0.001
    assert deepest <= allowed + 0.005
    read = read_program(text, dialect=DIALECTS[dialect]).on_panel(stock)
    assert read[:, 2].min() >= -bound - 1e-6
    assert twin_bites(read, tool).max() <= allowed + 0.001
    assert slab.heights.min() >= -bound - 1e-6


def test_a_second_program_is_asked_what_the_first_one_left():
    machine = Machine("m", "", TRAVEL, RATE, (30.0,) * 3, (0.0, 1e4), 1e4)
    setup = Setup(machine, Material("w", "W", 1.0, 1.0), Stock(15.0, 10.0, 4.0), 3.0)
    slab = Slab.whole(GRID, setup.stock)

    def slot(z):
        points = np.array([[3, 5, 5], [3, 5, z], [9, 5, z], [9, 5, 5]], float)
        feed = np.array([np.inf, 200, 200, np.inf])
        return Toolpath("rough", points, feed, cutter(), 8000.0)

    with pytest.raises(FindingsError, match=r"takes 2\.000 mm at once, where c may take 1 mm"):
        write_program(slot(-2.0), setup, slab)
    write_program(slot(-1.0), setup, slab)
    write_program(slot(-2.0), setup, slab)
