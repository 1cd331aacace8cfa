"""The writer: what it writes reads back, and what breaks a limit is not written."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.cutter import Cutter
from relieffab.errors import FindingsError, InputError
from relieffab.gcode.header import harmless
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

MACHINE = Machine(
    "mill",
    "",
    (200.0, 160.0, 40.0),
    (1500.0, 1200.0, 600.0),
    (30.0,) * 3,
    (2000.0, 10000.0),
    1000.0,
)
STOCK = Stock(120.0, 90.0, 10.0, work_zero=(60.0, 45.0, 0.0))
BALL = Cutter("ball", "ball", 2.0, 6.0, 10.0, 800.0, 300.0, 8000.0)


def path(points, feed, cutter=BALL, rpm=8000.0):
    return Toolpath("finish", np.array(points, float), np.array(feed, float), cutter, rpm)


def slot(z=-1.0, feed=800.0):
    points = [[10, 10, 5], [10, 10, z], [50, 10, z], [50, 10, 5]]
    return path(points, [np.inf, 300, feed, np.inf])


WOOD = Material("wood", "Wood", 1.0, 1.0)
GRID = Grid(90, 120, 1.0, (0.0, 90.0))


def write(toolpath, stock=STOCK, depth=4.0, header=None):
    slab = Slab.whole(GRID, stock)
    return write_program(toolpath, Setup(MACHINE, WOOD, stock, depth), slab, header=header)


def test_a_slot_word_for_word():
    text = write(slot())
    code = [line for line in text.splitlines() if not line.startswith("(")]
    assert code == [
        "G21 G90 G17 G94 G54",
        "G0 Z5",
        "M3 S800",
        "G4 P4",
        "G0 X-50 Y-35",
        "G1Z-1F300",
        "X-10F800",
        "G0Z5",
        "M5",
        "M30",
    ]


def test_plain_ascii_in_short_lines_free_of_bytes_that_act():
    text = write(slot(), header={"model": "Bäume ~ (wild!) " + "word " * 60, "stepover": "0.2 mm?"})
    assert text.isascii()
    assert max(map(len, text.splitlines())) <= 79
    assert not set("!~?%$") & set(text)
    assert "(stepover: 0.2 mm)" in text
    assert read_program(text).line_count == len(text.splitlines())


@settings(max_examples=40, deadline=None)
@given(
    arrays(float, st.tuples(st.integers(1, 30), st.just(3)), elements=st.floats(0, 1)),
    st.data(),
)
def test_what_is_written_reads_back(unit, data):
    points = unit * [110.0, 80.0, 6.0] + [5.0, 5.0, -3.5]
    choices = st.sampled_from([120.0, 333.3, 600.0])
    feed = data.draw(arrays(float, len(points), elements=choices))
    feed[0] = np.inf
    points[0, 2] = 5.0
    program = read_program(write(path(points, feed)))
    moved = program.on_panel(STOCK)
    # Rounding merges points closer than a step; each keeps its place in the order.
    at = 0
    for point in points:
        while not (
            (np.abs(moved[at, :2] - point[:2]) <= 0.0005 + 1e-9).all()
            and -1e-8 <= moved[at, 2] - point[2] <= 0.001
        ):
            at += 1
    assert len(moved) <= len(points) + 1
    if len(moved) == len(points) + 1:
        assert np.allclose(program.feed, [*feed, np.inf], rtol=0, atol=0.1)
    assert (np.diff(moved, axis=0) != 0).any(axis=1).all()


def test_feeds_and_rapids_read_back():
    program = read_program(write(slot()))
    assert program.feed.tolist() == [np.inf, 300, 800, np.inf]
    assert program.spindle.tolist() == [800] * 4
    assert program.dwell.tolist() == [4, 0, 0, 0, 0]


def test_z_never_rounds_down():
    program = read_program(write(slot(z=-1.2349)))
    assert program.points[:, 2].min() == -1.234


def test_harmless_keeps_plain_words():
    assert harmless("finish, 0.2 mm; F800") == "finish, 0.2 mm F800"


@pytest.mark.parametrize(
    ("toolpath", "options", "words"),
    [
        (slot(z=-4.5), {}, "below the relief's depth"),
        (slot(z=-7.0), {"depth": 9.0}, "below the cutter's flutes"),
        (slot(z=-5.5), {"depth": 9.0, "stock": Stock(120, 90, 5)}, "through the stock"),
        (slot(), {"stock": Stock(45, 90, 10)}, "outside the stock"),
        (slot(feed=1201.0), {"stock": Stock(120, 90, 10)}, None),
        (slot(feed=1501.0), {}, "above the machine's"),
        (path([[10, 10, 5], [10, 10, -1]], [np.inf, 601]), {}, "above the machine's"),
        (path([[10, 10, 5], [10, 10, -1]], [np.inf, np.inf]), {}, "below the panel's face"),
        (
            path([[10, 10, 5], [10, 10, -1], [20, 10, 5]], [np.inf, 100, np.inf]),
            {},
            "below the panel's face",
        ),
        (path([[-100, 10, 5], [101, 10, 5]], [np.inf, np.inf]), {}, "201.000 mm of X"),
    ],
)
def test_what_breaks_a_limit_is_not_written(toolpath, options, words):
    if words is None:
        assert write(toolpath, **options)
    else:
        with pytest.raises(FindingsError, match=words):
            write(toolpath, **options)


def test_a_spindle_speed_the_machine_lacks():
    toolpath = path([[10, 10, 5], [10, 10, -1]], [np.inf, 100], rpm=12000.0)
    with pytest.raises(InputError, match="spindle"):
        write(toolpath)


def test_a_feed_too_slow_to_write():
    with pytest.raises(InputError, match="too slow"):
        write(path([[10, 10, 5], [10, 10, -1]], [np.inf, 0.05]))
