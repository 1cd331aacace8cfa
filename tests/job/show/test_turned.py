"""Programs for a rotary axis, shown without their job."""

import numpy as np
import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.gcode.aids import outline_program
from relieffab.gcode.setup import Setup
from relieffab.job.show.carved import show_program
from relieffab.job.show.lit import Lit
from relieffab.job.show.maker import run_of
from relieffab.machine import turning
from relieffab.stock import Stock

HEAD = """(machine: {machine})
(cutter: flat-3.175, flat 3.175 mm)
(stock: round, 40 mm thick, 45 mm along X from the figure's top, {turn})
(work zero: X 0 Y 0 mm from the figure's top right, Z 0 mm from the face)
"""
# A slot a quarter of a turn from work zero, 10 to 35 mm along the axis.
BY_A = """G21 G90 G17 G94 G54
M3 S8000
G0 Z5
G0 X10 A90
G93
G1 Z-1 F100
G1 X35 F20
G94
G0 Z5
M5
M30
"""
BY_Y = "\n".join(
    line.replace("A90", f"Y{-10 * np.pi:.3f}").replace("F100", "F300").replace("F20", "F500")
    for line in BY_A.splitlines()
    if line not in ("G93", "G94")
)
PROGRAMS = {
    "A": HEAD.format(machine="altmill-4x4-rotary, grblHAL", turn="A turns") + BY_A,
    "Y": HEAD.format(machine="3018-prover-rotary, Grbl 1.1", turn="Y is mm") + BY_Y + "\n",
}


@pytest.mark.parametrize("letter", "AY")
def test_what_turns_is_shown_upright_on_the_face_laid_out(letter, tmp_path):
    path = tmp_path / "slot.nc"
    path.write_text(PROGRAMS[letter])
    shown = show_program(path, Lit())
    assert (shown.facts["diameter_mm"], shown.facts["length_mm"]) == (40, 45)
    assert shown.facts["deepest_mm"] == pytest.approx(1, abs=0.07)
    image = shown.image.astype(int).sum(axis=2)
    rows, cols = image.shape
    assert cols / rows == pytest.approx(40 * np.pi / 45, rel=0.01)
    # It lies a quarter of the way round from the figure's right edge, and nowhere else.
    differs = np.abs(image - np.median(image)) > 30
    where = np.nonzero(differs)
    assert where[1].mean() / cols == pytest.approx(0.75, abs=0.01)
    assert where[0].min() / rows * 45 == pytest.approx(10 - 1.6, abs=0.5)
    assert where[0].max() / rows * 45 == pytest.approx(35 + 1.6, abs=0.5)


def test_a_program_that_turns_and_does_not_tell_what_is_refused(tmp_path):
    path = tmp_path / "slot.nc"
    path.write_text(BY_A)
    with pytest.raises(InputError, match="does not tell the stock that it turns"):
        run_of(path, cutter="flat-3.175", machine="altmill-4x4-rotary")


def test_an_outline_in_the_air_cuts_nothing(tmp_path):
    stock = Stock(45, 60, 20, radius=20)
    machine = turning(profiles.machine("altmill-4x4-rotary"), 20)
    path = tmp_path / "00-outline.nc"
    path.write_text(outline_program(Setup(machine, profiles.material("softwood"), stock, 3.0)))
    with pytest.raises(InputError, match="cuts nothing"):
        run_of(path)
