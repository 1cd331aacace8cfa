"""Seams are measured where windows overlap, and nowhere else."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.gcode.seams import seam_findings, seams_of
from relieffab.grid import Grid
from relieffab.toolpath.positions import Position

BALL = Cutter("ball-2", "ball", 2.0, 6.0, 2.5, 800.0, 300.0, 8000.0)
GRID = Grid(100, 300, 0.1, (0.0, 10.0))
FIRST = Position(1, 2, (0.0, 0.0), (16.0, 10.0), (0.0, 0.0))
SECOND = Position(2, 2, (14.0, 0.0), (30.0, 10.0), (14.0, 0.0))


def measured(deviation, places=(FIRST, FIRST, SECOND)):
    return seams_of(places, [BALL, BALL], GRID, deviation.astype(np.float32), 0.1)


def test_a_ridge_between_two_windows_is_found():
    deviation = np.full(GRID.node_shape, 0.01)
    deviation[:, :125] = 0.7
    deviation[:, 148:153] = 0.3
    (seam,) = measured(deviation)
    assert seam.between == (1, 2)
    assert seam.error_mm == pytest.approx(0.3)
    # Five of the 41 columns from X 13 to X 17.
    assert seam.within_tolerance == pytest.approx(36 / 41)
    (text,) = seam_findings([seam], 0.1, 0.9)
    assert "87.8% of the seam between positions 1 and 2" in text
    assert seam_findings([seam], 0.1, 0.87) == []


def test_a_gouge_counts_as_much_as_a_ridge():
    assert measured(np.full(GRID.node_shape, -0.2))[0].error_mm == pytest.approx(0.2)


def test_off_the_figure_and_at_one_position_there_is_no_seam():
    assert measured(np.full(GRID.node_shape, np.nan)) == ()
    assert measured(np.zeros(GRID.node_shape), [FIRST, FIRST]) == ()
