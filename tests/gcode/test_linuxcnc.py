"""LinuxCNC's interpreter, which nobody here wrote, goes where our reader goes."""

import json
import subprocess
from math import atan2, pi
from pathlib import Path

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.gcode.aids import outline_program, probe_program
from relieffab.gcode.dialect import DIALECTS, GRBL
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

PYTHON = "/usr/bin/python3"  # the one the module was built for
SCRIPT = Path(__file__).with_name("linuxcnc_canon.py")


def present():
    try:
        found = subprocess.run([PYTHON, "-c", "import gcode"], capture_output=True, check=False)
    except OSError:
        return False
    return found.returncode == 0


pytestmark = pytest.mark.skipif(
    not present(), reason="LinuxCNC's interpreter is not installed; .ci/run does"
)


def interpreted(text, folder):
    """Moves as LinuxCNC's interpreter makes them, mm; its complaint, if any."""
    path = folder / "program.ngc"
    path.write_text(text, encoding="ascii")
    # Nothing of this environment's Python: the module belongs to the system's.
    answer = subprocess.run(
        [PYTHON, "-E", str(SCRIPT), str(folder), str(path)], capture_output=True, check=True
    )
    told = json.loads(answer.stdout)
    return told["moves"], told["fault"]


def places(moves, read):
    """Points of LinuxCNC's path, its arcs cut into as many chords as the reader's."""
    counts = np.bincount(read.line)
    points, lines = [], []
    start = np.zeros(3)
    for kind, line, x, y, z, *arc in moves:
        end = np.array([x, y, z]) * 25.4
        if line >= len(counts) or not counts[line]:
            start = end
            continue
        count = int(counts[line]) if kind == "arc" else 1
        centre = np.array(arc[:2]) * 25.4
        for k in range(1, count + 1):
            points.append(end if kind != "arc" else along(start, end, centre, arc[2], k / count))
            lines.append(line)
        start = end
    return np.array(points), np.array(lines)


def along(start, end, centre, turns, share):
    """A point of an arc, `share` of its sweep from the start."""
    a, b = start[:2] - centre, end[:2] - centre
    sweep = (atan2(b[1], b[0]) - atan2(a[1], a[0])) % (2 * pi)
    if turns < 0:
        sweep -= 2 * pi
    if abs(sweep) < 1e-9 or abs(abs(sweep) - 2 * pi) < 1e-9:
        sweep = 2 * pi if turns > 0 else -2 * pi
    c, s = np.cos(sweep * share), np.sin(sweep * share)
    spin = centre + np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    return np.append(spin, start[2] + (end[2] - start[2]) * share)


def same_path(text, folder, dialect=GRBL):
    """Compare both readings of a program: same lines, same places within 1 um, same rapids."""
    moves, fault = interpreted(text, folder)
    assert fault == ""
    read = read_program(text, dialect=dialect)
    points, lines = places(moves, read)
    assert lines.tolist() == read.line.tolist()
    assert np.abs(points - read.points).max() < 1e-3
    rapid = {line for kind, line, *_ in moves if kind == "rapid"}
    assert rapid >= set(read.line[read.rapid].tolist())
    assert not rapid & set(read.line[~read.rapid].tolist())
    return read


HEAD = "G21 G90 G17 G94 G54\nG0 Z5\nX1 Y2\nM3 S800\n"


@pytest.mark.parametrize(
    "body",
    [
        "G1Z-1F300\nX10.1234Y.5\nZ-1.25\nG0Z5",
        "G1Z-1F300\nG2X20I9.5J0\nG3X21Y3I0J1\nG1X2",
        "G1Z-1F300\nG2X20I9.5J0Z-2\nG0Z5",
        "G1 Z-1 F300\nG2X1Y2I5J1\nG3X1Y2I-3",
        "G1Z0F100\nG3X5Y6R4\nG2X9Y2R-3",
        "G20\nG1Z-.05F12\nX.33333Y-.12345\nG3X.5Y.2R.3\nG2X.7I.1J0\nG21\nG0Z5",
        "G91\nG1Z-6F100\nX1.5\nG2X2I1J0\nG90 G1\nX0",
        "G91 G20\nG1Z-.2F10\nX.1\nG3X.1Y.1I0J.1\nG90 G21\nG0 Z5",
    ],
)
def test_the_same_path(body, tmp_path):
    read = same_path(f"{HEAD}{body}\nM5\nM30\n", tmp_path)
    assert len(read.points) >= 4


def test_the_comparison_can_fail(tmp_path):
    moves, _ = interpreted(f"{HEAD}G1Z-1F300\nX10\nM30\n", tmp_path)
    read = read_program(f"{HEAD}G1Z-1F300\nX10.002\nM30\n")
    points, _ = places(moves, read)
    assert np.abs(points - read.points).max() == pytest.approx(0.002)


@pytest.mark.parametrize("body", ["G1F100X5\nG2X9Y9", "G1F100X5\nG2X9Y9I1J1", "G1F1X1X2"])
def test_it_refuses_what_our_reader_refuses(body, tmp_path):
    _, fault = interpreted(f"{HEAD}{body}\nM30\n", tmp_path)
    assert "line" in fault
    with pytest.raises(Exception, match="Grbl error"):
        read_program(f"{HEAD}{body}\nM30\n")


BALL = Cutter("ball", "ball", 2.0, 6.0, 9.0, 800.0, 300.0, 8000.0)
TRAVEL, RATE = (200.0, 160.0, 40.0), (1500.0, 1200.0, 1500.0)


def setup_of(dialect, units, zero=("near-left", "top")):
    machine = Machine("mill", "", TRAVEL, RATE, (30.0,) * 3, (0.0, 1e4), 1e4, dialect=dialect)
    stock = Stock.zeroed((120.0, 90.0, 10.0), *zero)
    return Setup(machine, Material("wood", "Wood", 1.0, 1.0), stock, 4.0, units)


def scattered(seed, count=400):
    rng = np.random.default_rng(seed)
    points = rng.random((count, 3)) * [110, 80, 3.9] + [5, 5, -3.9]
    feed = rng.choice([120.0, 333.3, 600.0], count)
    points[0, 2], feed[0] = 5.0, np.inf
    return Toolpath("finish", points, feed, BALL, 8000.0)


def rings():
    """Level circles both ways, as strokes and contours give them."""
    angle = np.linspace(0, 2 * np.pi, 361)
    points = [[30.0, 40.0, 5.0]]
    feed = [np.inf]
    for k, (radius, way) in enumerate([(2.0, 1), (7.3, -1), (19.0, 1)]):
        x, y = 30 + radius * np.cos(way * angle), 40 + radius * np.sin(way * angle)
        ring = np.column_stack([x, y, np.full(len(x), -0.5 - k)])
        points += [[x[0], y[0], 5.0], *ring, [x[-1], y[-1], 5.0]]
        feed += [np.inf, 300.0, *[600.0] * (len(x) - 1), np.inf]
    return Toolpath("lines", np.array(points), np.array(feed), BALL, 8000.0)


@pytest.mark.parametrize("units", ["mm", "in"])
@pytest.mark.parametrize("dialect", sorted(DIALECTS.keys() - {"marlin"}))  # which it cannot read
def test_written_programs(dialect, units, tmp_path):
    setup = setup_of(dialect, units, ("centre", "bottom"))
    many = [scattered(5), rings()] if "M6" in DIALECTS[dialect].codes else [rings()]
    slab = Slab.whole(Grid(90, 120, 1.0, (0.0, 90.0)), setup.stock)
    text = write_program(many, setup, slab)
    assert 6 <= sum("I" in line and line[0] in "GX" for line in text.splitlines()) <= 12
    read = same_path(text, tmp_path, DIALECTS[dialect])
    assert len(read.by_tool()) == len(many)
    points = read.by_tool()[-1].on_panel(setup.stock)
    low = points[points[:, 2] < 0]
    radius = np.hypot(low[:, 0] - 30, low[:, 1] - 40)
    assert np.abs(radius[:, None] - [2.0, 7.3, 19.0]).min(axis=1).max() < 0.002


@pytest.mark.parametrize("units", ["mm", "in"])
def test_outlines_and_probes(units, tmp_path):
    setup = setup_of("linuxcnc", units, ("far-right", "bottom"))
    same_path(outline_program(setup), tmp_path, DIALECTS["linuxcnc"])
    moves, fault = interpreted(probe_program(setup, 19.0), tmp_path)
    assert fault == "" and len(moves) == 2


@pytest.mark.parametrize("units", ["mm", "in"])
@pytest.mark.parametrize("dialect", ["fluidnc", "grblhal", "linuxcnc", "mach3"])
def test_programs_that_turn_the_work(dialect, units, tmp_path):
    radius = 20.0
    flat = setup_of(dialect, units)
    stock = Stock(120.0, 90.0, 10.0, work_zero=(60.0, 45.0, -radius), radius=radius)
    setup = Setup(flat.machine, flat.material, stock, 4.0, units)
    slab = Slab.whole(Grid(90, 120, 1.0, (0.0, 90.0)), stock)
    text = write_program(scattered(7), setup, slab)
    for whole in (text, outline_program(setup)):
        moves, fault = interpreted(whole, tmp_path)
        assert fault == ""
        read = read_program(whole, dialect=DIALECTS[dialect], radius=radius)
        known = [move for move in moves if move[1] in set(read.line.tolist())]
        assert [move[1] for move in known] == read.line.tolist()
        x, _, z, a = (
            np.array(column) for column in zip(*[move[2:] for move in known], strict=True)
        )
        found = np.column_stack([x * 25.4, -np.radians(a) * radius, z * 25.4])
        assert np.abs(found - read.points).max() < 1e-3
    back = read_program(text, dialect=DIALECTS[dialect], radius=radius)
    assert (back.feed[~back.rapid] <= 600.0 * (1 + 1e-9)).all()
