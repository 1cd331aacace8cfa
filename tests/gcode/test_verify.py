"""Verification passes a sound program and catches each seeded fault in its text."""

import re
from dataclasses import replace

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.missed import missed_patch
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import figure_nodes, verify
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.positions import Position

MACHINE = Machine(
    "mill", "", (200.0, 160.0, 40.0), (1500.0,) * 3, (300.0,) * 3, (2000.0, 10000.0), 10000.0
)
STOCK = Stock(30.0, 20.0, 8.0, work_zero=(15.0, 10.0, 0.0))
BALL = Cutter("ball-2", "ball", 2.0, 6.0, 2.5, 800.0, 300.0, 8000.0)
WOOD = Material("wood", "Wood", 1.0, 1.0)
SETUP = Setup(MACHINE, WOOD, STOCK, 2.0)


def bowl():
    grid = Grid.on_panel((30.0, 20.0), (150, 100))
    x, y = np.meshgrid(*grid.node_axes())
    r = np.minimum(np.hypot((x - 15) / 12, (y - 10) / 8), 1)
    mask = np.hypot(*np.meshgrid((np.arange(150) - 74.5) / 60, (np.arange(100) - 49.5) / 40)) < 1
    return Relief(grid, -2.0 * (1 + np.cos(np.pi * r)) / 2, mask, 2.0)


RELIEF = bowl()


def finish(stepover=0.5):
    """Rows along X at the lowest a ball may go, each from the air and back."""
    terrain = Terrain.of(RELIEF)
    points, feed = [], []
    x = np.linspace(2, 28, 261)
    for y in np.arange(1.25, 18.9, stepover):
        z = np.minimum(tip_heights(terrain, BALL, x, np.full(len(x), y)), 0)
        row = np.column_stack([x, np.full(len(x), y), z])
        points += [[[x[0], y, 5]], row, [[x[-1], y, 5]]]
        feed += [[np.inf, 300], [800] * (len(x) - 1), [np.inf]]
    path = Toolpath("finish", np.concatenate(points), np.concatenate(feed), BALL, 8000.0)
    return write_program(path, SETUP, Slab.whole(RELIEF.grid, STOCK))


TEXT = finish()


def judge(text, **options):
    return verify([text], [BALL], RELIEF, SETUP, **options)


def found(text, **options):
    result = judge(text, **options)
    assert result.ok == (not result.findings)
    return " | ".join(result.findings)


def test_a_sound_program_passes():
    result = judge(TEXT, tolerance=0.05)
    assert result.findings == () and result.ok
    assert result.gouge_mm < 0.002
    # Rows 0.5 mm apart with a ball of 1 mm radius leave scallops of 0.032 mm.
    assert 0.015 < result.excess_p99_mm < 0.04
    assert result.within_tolerance > 0.999
    assert result.deviation.shape == result.grid.node_shape == (401, 601)
    assert result.tolerance_mm == 0.05


def deepen(text, by):
    """Lower one cutting move of the row, as a slip of the keyboard would."""
    lines = text.splitlines()
    at = [k for k, line in enumerate(lines) if line.startswith("X1Z-")][17]
    z = float(lines[at].split("Z")[1])
    lines[at] = f"X1Z{z - by:.3f}"
    return "\n".join(lines)


def test_a_gouge_of_a_twentieth_is_caught():
    result = judge(deepen(TEXT, 0.05))
    (text,) = result.findings
    assert "gouges the relief" in text and " at X 16" in text
    assert 0.045 < result.gouge_mm < 0.055
    assert result.deviation.min() == pytest.approx(-result.gouge_mm, abs=0.002)
    assert judge(deepen(TEXT, 0.05), gouge_limit=0.06).ok
    assert judge(deepen(TEXT, 0.004)).ok


def without_row(text, y):
    lines = text.splitlines()
    first = next(k for k, line in enumerate(lines) if re.fullmatch(rf".*Y{y}", line))
    last = next(k for k in range(first + 1, len(lines)) if "Y" in lines[k])
    return "\n".join(lines[:first] + lines[last:])


def test_a_missing_row_is_caught():
    row = without_row(TEXT, "0.25")
    assert len(row) < len(TEXT)
    result = judge(row, tolerance=0.05)
    (text,) = result.findings
    assert "left" in text and "could reach" in text
    assert result.within_tolerance < judge(TEXT, tolerance=0.05).within_tolerance


def test_a_program_that_cuts_nothing_is_caught():
    text = "G21 G90\nG0 Z5\nX0 Y0\nM30"
    assert "only" in found(text) and "could reach" in found(text)


def test_a_cut_into_the_flat_face_is_a_gouge():
    text = TEXT.replace("M5\n", "X-14Y-9\nG1Z-.5F100\nG0Z5\nM5\n")
    assert judge(text).gouge_mm == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("G0Z5\nM5", "G0X0Y0Z-0.2\nG0Z5\nM5"), "rapid goes through"),
        (("G0Z5\nM5", "X12Z-.1\nG0X-13\nG0Z5\nM5"), "rapid goes below"),
        (("G0Z5\nM5", "G1X0Y0Z-2.01\nG0Z5\nM5"), "below the relief's depth of 2 mm"),
        (("G0Z5\nM5", "G1X0Y0Z-6.5\nG0Z5\nM5"), "below the cutter's flutes"),
        (("G0Z5\nM5", "G1X0Y0Z-8.5\nG0Z5\nM5"), "through the stock of 8 mm"),
        (("G0Z5\nM5", "G1X17Z-0.1\nG0Z5\nM5"), "outside the stock of 30 x 20 mm"),
        (("G0Z5\nM5", "G0Z5\nX190\nM5"), "mm of X, where mill has 200"),
        (("F800", "F1600"), "a feed is above"),
        (("M3 S8000", "M3 S0"), "spindle off"),
        (("M3 S8000\n", ""), "spindle off"),
        (("G0 Z5\n", "G0 X0\nG0 Z5\n"), "sideways before it sets a height"),
    ],
)
def test_seeded_faults_are_caught(change, words):
    assert TEXT.count(change[0]) >= 1
    assert words in found(TEXT.replace(*change))


def test_programs_share_one_travel():
    left = "G21 G90\nG0 Z5\nX-150 Y0\nX0\nM30"
    right = "G21 G90\nG0 Z5\nX150 Y0\nX0\nM30"
    result = verify([TEXT, left, right], [BALL] * 3, RELIEF, SETUP)
    (text,) = result.findings
    assert text.startswith("all programs: moves over 300.000 mm of X")


def test_a_gouge_is_measured_square_to_a_wall():
    grid = Grid(20, 20, 0.1, (0.0, 2.0))
    heights = np.zeros(grid.node_shape)
    heights[:, 10:] = -4.0
    relief = Relief(grid, heights, np.ones(grid.shape, bool), 4.0)
    flat = Cutter("flat", "flat", 1.0, 6.0, 1.0, 800.0, 300.0, 8000.0)
    setup = Setup(MACHINE, WOOD, Stock(2.0, 2.0, 8.0), 4.0)
    # Halfway down the wall, at X 0.95, the cutter's rim touches at Z -2.
    body = "G21 G90\nG0 Z5\nX{} Y1\nM3 S8000\nG1 Z-2 F100\nG0 Z5\nM30"

    def gouge(x):
        return verify([body.format(x)], [flat], relief, setup).gouge_mm

    assert gouge(1.45) < 1e-9
    # The crest at X 0.9 is cut away: its whole height, but 0.05 mm into the wall.
    assert 0.0499 < gouge(1.39) < 0.065


def test_nodes_of_the_figure():
    relief = Relief(Grid(3, 3, 1.0, (0, 3)), np.zeros((4, 4)), np.eye(3, dtype=bool), 1.0)
    stock = Stock(3.0, 3.0, 8.0)
    fine = figure_nodes(relief, Grid(6, 6, 0.5, (0, 3)), stock)
    assert fine.sum() == 3 * 9 - 2
    assert fine[2, 2] and fine[0, 2] and not fine[0, 3]
    grown = figure_nodes(relief, Grid(8, 8, 0.5, (-0.5, 3.5)), stock)
    assert np.array_equal(grown[1:8, 1:8], fine)


def test_marks_beside_the_figure_are_judged_too():
    heights = RELIEF.heights.copy()
    heights[4:8, 4:30] = -0.3  # as a pecked ground's, which no program here cuts
    result = verify([TEXT], [BALL], replace(RELIEF, heights=heights), SETUP)
    assert judge(TEXT).within_tolerance - result.within_tolerance > 0.01
    assert result.figure.sum() - judge(TEXT).figure.sum() == (5 * 4 + 1) * (27 * 4 + 1)


def test_what_the_cutter_cannot_reach_is_not_missed():
    grid = Grid(40, 40, 0.1, (0.0, 4.0))
    heights = np.zeros(grid.node_shape)
    heights[:, 19:22] = -2.0
    relief = Relief(grid, heights, np.ones(grid.shape, bool), 2.0)
    assert missed_patch(relief, -heights, BALL, 0.1) < 0.5
    assert missed_patch(relief, heights + 0.0, BALL, 0.1) == 0
    fine = Cutter("flat", "flat", 0.2, 6.0, 1.0, 800.0, 300.0, 8000.0)
    assert missed_patch(relief, -heights, fine, 0.1) > 0.1 * 3 * 3.5


def test_large_reliefs_are_judged_on_half_as_fine_a_lattice(monkeypatch):
    assert judge(TEXT).grid.pitch == pytest.approx(RELIEF.grid.pitch / 4)
    assert judge(TEXT, refine=1).grid.pitch == pytest.approx(RELIEF.grid.pitch)
    monkeypatch.setattr("relieffab.gcode.verify.LARGE", RELIEF.mask.size - 1)
    assert judge(TEXT).grid.pitch == pytest.approx(RELIEF.grid.pitch / 2)


def test_bad_use():
    blank = Relief(RELIEF.grid, RELIEF.heights * 0, RELIEF.mask & False, 2.0)
    with pytest.raises(InputError, match="no figure"):
        verify([TEXT], [BALL], blank, SETUP)
    with pytest.raises(InputError, match="no program"):
        verify([], [], RELIEF, SETUP)
    with pytest.raises(InputError, match="program 1 line 3"):
        judge("G21 G90\nG0 Z5\nG1 X0 Y0\nM30")


FIRST = Position(1, 2, (0.0, 0.0), (17.0, 20.0), (0.0, 0.0))
SECOND = Position(2, 2, (13.0, 0.0), (30.0, 20.0), (13.0, 0.0))
TURNED = Position(2, 2, (13.0, 0.0), (30.0, 20.0), (30.0, 20.0), turned=True)


def part(place, stop=None):
    """Rows of `finish` within a window, as a program for the stock as it lies then."""
    terrain = Terrain.of(RELIEF)
    points, feed = [], []
    x = np.linspace(max(place.low[0] + 0.1, 2), min(stop or place.high[0] - 0.1, 28), 171)
    for y in np.arange(1.25, 18.9, 0.5):
        z = np.minimum(tip_heights(terrain, BALL, x, np.full(len(x), y)), 0)
        row = np.column_stack([x, np.full(len(x), y), z])
        points += [[[x[0], y, 5]], row, [[x[-1], y, 5]]]
        feed += [[np.inf, 300], [800] * (len(x) - 1), [np.inf]]
    path = Toolpath("finish", np.concatenate(points), np.concatenate(feed), BALL, 8000.0)
    return write_program(path, SETUP.at(place), Slab.whole(RELIEF.grid, STOCK))


@pytest.mark.parametrize("second", [SECOND, TURNED])
def test_programs_of_two_positions_are_judged_together(second):
    texts = [part(FIRST), part(second)]
    both = verify(texts, [BALL] * 2, RELIEF, SETUP, positions=[FIRST, second], tolerance=0.05)
    assert both.findings == ()
    assert both.gouge_mm < 0.002 and both.within_tolerance > 0.999
    (seam,) = both.seams
    assert seam.between == (1, 2) and seam.error_mm < 0.04
    one = verify(texts[:1], [BALL], RELIEF, SETUP, positions=[FIRST])
    assert one.seams == () and not one.ok


def test_a_position_confused_with_another_gouges():
    texts = [part(FIRST), part(SECOND)]
    for wrong in ([FIRST, TURNED], [SECOND, FIRST], [FIRST, replace(SECOND, zero=(13.1, 0.0))]):
        verdict = verify(texts, [BALL] * 2, RELIEF, SETUP, positions=wrong)
        assert any("gouges the relief" in text for text in verdict.findings)


def test_a_gap_between_two_positions_is_found():
    second = replace(SECOND, low=(15.8, 0.0))
    texts = [part(FIRST, stop=14.0), part(second)]
    verdict = verify(texts, [BALL] * 2, RELIEF, SETUP, positions=[FIRST, second])
    assert any("of the seam between positions 1 and 2" in text for text in verdict.findings)
    assert verdict.seams[0].within_tolerance < 0.9 < verdict.within_tolerance


def test_a_program_beyond_its_window_is_found():
    narrow = replace(FIRST, high=(15.0, 20.0))
    verdict = verify(
        [part(FIRST), part(SECOND)], [BALL] * 2, RELIEF, SETUP, positions=[narrow, SECOND]
    )
    (text,) = verdict.findings
    assert text.startswith("program 1: leaves the window of position 1")


def test_travel_counts_at_each_position_by_itself():
    setup = replace(SETUP, machine=replace(MACHINE, travel=(17.0, 160.0, 40.0)))
    texts = [part(FIRST), part(SECOND)]
    assert verify(texts, [BALL] * 2, RELIEF, setup, positions=[FIRST, SECOND]).ok
    moved = verify(texts, [BALL] * 2, RELIEF, setup)
    assert not moved.ok
