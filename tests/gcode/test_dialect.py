"""What each controller takes is written, and what it does not take is refused."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.dialect import DIALECTS, dialect
from relieffab.gcode.post import Post
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

BALL = Cutter("ball", "ball", 2.0, 6.0, 4.0, 800.0, 300.0, 8000.0)
RATE = (3000.0, 2000.0, 700.0)
EVERY = pytest.mark.parametrize("name", sorted(DIALECTS))


def setup_of(name, units="mm"):
    machine = Machine("mill", "", (200.0,) * 3, RATE, (30.0,) * 3, (0.0, 1e4), 1e4, dialect=name)
    return Setup(machine, Material("wood", "Wood", 1.0, 1.0), Stock(60.0, 40.0, 9.0), 4.0, units)


def slot(y=10.0):
    points = np.array([[10, y, 5], [10, y, -1], [50, y, -1.5], [50, y, 5], [50, y, 1]], float)
    return Toolpath("finish", points, np.array([np.inf, 300, 800, np.inf, np.inf]), BALL, 8000.0)


def write(name, units="mm", paths=None):
    setup = setup_of(name, units)
    slab = Slab.whole(Grid(40, 60, 1.0, (0.0, 40.0)), setup.stock)
    return write_program(paths or slot(), setup, slab)


@EVERY
def test_its_own_programs_read_back_alike(name):
    program = read_program(write(name), dialect=DIALECTS[name])
    grbl = read_program(write("grbl"))
    assert np.array_equal(program.points, grbl.points)
    assert np.array_equal(program.feed, grbl.feed)
    assert program.dwell.tolist() == grbl.dwell.tolist()
    lines = write(name).splitlines()
    assert max(map(len, lines)) <= DIALECTS[name].characters
    assert all(line[0] == DIALECTS[name].comments for line in lines[:5])


@EVERY
def test_inches(name):
    if name == "marlin":
        with pytest.raises(InputError, match="no programs in inches"):
            setup_of(name, "in")
        return
    text = write(name, "in")
    assert "G20" in text and "G21" not in text
    program = read_program(text, dialect=DIALECTS[name])
    metric = read_program(write(name), dialect=DIALECTS[name])
    assert np.abs(program.points - metric.points).max() < 0.001
    assert (program.points[:, 2] >= metric.points[:, 2] - 0.001).all()
    assert np.allclose(program.feed[1:], metric.feed[1:], rtol=1e-3)
    assert (program.feed <= metric.feed).all()


@EVERY
def test_changes_of_cutter(name):
    takes = name in ("grblhal", "linuxcnc", "mach3")
    assert ("M6" in DIALECTS[name].codes) == takes
    if not takes:
        with pytest.raises(InputError, match="changes no cutters"):
            write(name, paths=[slot(), slot(20.0)])
        return
    first, second = read_program(
        write(name, paths=[slot(), slot(20.0)]), dialect=DIALECTS[name]
    ).by_tool()
    assert (first.tool == 1).all() and (second.tool == 2).all()
    assert (first.points[1:, 1] == 10).all() and (second.points[-1, 1] == 20)
    assert first.dwell.sum() == second.dwell.sum() == 4


@pytest.mark.parametrize(
    ("line", "takers"),
    [
        ("M6 T1", {"grblhal", "linuxcnc", "mach3"}),
        ("G43 H1", {"linuxcnc", "mach3"}),
        ("G64 P0.01", {"linuxcnc", "mach3"}),
        ("M400", {"marlin"}),
        ("G17", set(DIALECTS) - {"marlin"}),
        ("G94", set(DIALECTS) - {"marlin"}),
        ("G54", set(DIALECTS) - {"marlin"}),
        ("G20", set(DIALECTS) - {"marlin"}),
        ("G91.1", set(DIALECTS) - {"marlin"}),
        ("(a comment)", set(DIALECTS) - {"marlin"}),
        ("G1 X10 F100\nX11", set(DIALECTS) - {"marlin"}),
        ("X" + "0" * 80 + "1", set(DIALECTS) - {"grbl", "marlin"}),
        ("G0 X" + "0" * 90 + "1", set(DIALECTS) - {"grbl"}),
        ("G0 X" + "0" * 252 + "1", {"grblhal", "mach3"}),
        ("G38.2 Z-1 F50", set()),
        ("M98", set()),
    ],
)
def test_what_each_does_not_take(line, takers):
    for name, one in DIALECTS.items():
        end = "" if line == one.end else one.end
        text = f"G21 G90\nG0 Z5\nG0 X0 Y0\n{line}\n{end}\n"
        if name in takers:
            assert read_program(text, dialect=one).points.size
        else:
            with pytest.raises(InputError, match=r"line (4|5)"):
                read_program(text, dialect=one)


def test_marlin_says_motion_and_speed_in_every_line_that_needs_them():
    code = [line for line in write("marlin").splitlines() if line[0] != ";"]
    assert code == [
        "G21 G90", "G0 Z5 F700", "M3 S8000", "G4 P4000", "G0 X10 Y10 F2000",
        "G1 Z-1 F300", "G1 X50 Z-1.5 F800", "G0 Z5 F700", "G0 Z1", "G0 Z5", "M5", "M400",
    ]  # fmt: skip


def test_linuxcnc_rounds_no_corner_by_more_than_two_microns():
    assert "G64 P0.002\n" in write("linuxcnc")
    assert "G64 P0.00008\n" in write("linuxcnc", "in")


def test_unknown_ones():
    with pytest.raises(InputError, match="did you mean grblhal"):
        dialect("grblhall")
    with pytest.raises(InputError, match="unknown dialect"):
        setup_of("heidenhain")
    with pytest.raises(InputError, match="unknown unit"):
        Post(units="cm")
