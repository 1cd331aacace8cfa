import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.job.show.carved import show_program
from relieffab.job.show.lit import Lit

LIT = Lit()
SQUARE = "G21 G90\nG0 Z5\nG0 X5 Y5\nM3 S1000\nG1 Z-1 F300\nG1 X15\nG1 Y15\nG0 Z5\nM5\nM30\n"


def test_a_program_of_a_job_cuts_what_those_before_it_left(job):
    shown = show_program(job / "02-finish.nc", LIT)
    assert "carved before it: 01-rough.nc" in shown.notes
    assert shown.facts["cutters"] == ["tapered-ball-1"]
    assert shown.facts["stock_mm"] == [40, 30, 12]
    assert 0.9 < shown.facts["deepest_mm"] <= 1.001
    assert shown.image.shape[1] == 1024
    rough = show_program(job / "01-rough.nc", LIT)
    assert rough.facts["deepest_mm"] < shown.facts["deepest_mm"]


def test_programs_of_others_need_their_cutter(tmp_path):
    path = tmp_path / "square.nc"
    path.write_text(SQUARE)
    with pytest.raises(InputError, match="does not tell its cutter"):
        show_program(path, LIT)
    shown = show_program(path, LIT, cutter="flat-3.175")
    assert shown.facts["deepest_mm"] == 1
    assert shown.facts["bounds_mm"] == [[5, 5, -1], [15, 15, 5]]
    width = shown.facts["stock_mm"][0]
    assert width == pytest.approx(15 + 1.5 * 3.175)
    grey = shown.image.astype(int).sum(axis=2)
    assert np.ptp(grey) > 100


def test_what_cuts_nothing_is_told(job, tmp_path):
    with pytest.raises(InputError, match="cuts nothing"):
        show_program(job / "00-outline.nc", LIT)
    with pytest.raises(InputError, match="no such program"):
        show_program(tmp_path / "no.nc", LIT)
