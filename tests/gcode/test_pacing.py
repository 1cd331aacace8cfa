"""Paths are simplified as far as their machine needs it, and no further."""

from dataclasses import replace

import numpy as np

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.gcode.pacing import STARVED, TOLERANCES, paced
from relieffab.gcode.setup import Setup
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

BALL = Cutter("ball", "ball", 2.0, 6.0, 4.0, 800.0, 300.0, 8000.0)
SHAPEOKO = profiles.machine("shapeoko-3")


def rows(step, feed):
    """Rows over a gentle relief, sampled at every step."""
    x = np.arange(5, 75, step)
    points, feeds = [np.array([[x[0], 5.0, 5.0]])], [np.array([np.inf])]
    for k in range(8):
        z = -1 - 0.3 * np.sin(0.4 * x) - 0.05 * np.sin(1.3 * x + k)
        row = np.column_stack([x, np.full(len(x), 5 + 0.3 * k), z])
        points.append(row[:: -1 if k % 2 else 1])
        feeds.append(np.full(len(x), feed))
    return Toolpath("finish", np.concatenate(points), np.concatenate(feeds), BALL, 8000.0)


def fit(path, machine):
    stock = Stock(80.0, 20.0, 9.0)
    return paced(path, Setup(machine, profiles.material(), stock, 3.0))


def test_a_path_that_keeps_the_machine_fed_is_left_alone():
    path = rows(1.0, 600.0)
    found = fit(path, SHAPEOKO)
    assert found.path is path and found.tolerance == 0
    assert found.warning == "" and found.pace.starved <= STARVED


def test_a_dense_path_is_simplified_until_it_does():
    path = rows(0.04, 3000.0)
    found = fit(path, SHAPEOKO)
    assert 0 < found.tolerance <= max(TOLERANCES)
    assert found.pace.starved <= STARVED and found.warning == ""
    assert len(found.path.points) < len(path.points) / 3
    coarser = [t for t in TOLERANCES if t < found.tolerance]
    assert coarser and found.tolerance == TOLERANCES[len(coarser)]


def test_a_controller_too_slow_for_any_tolerance_is_warned_of():
    slow = replace(SHAPEOKO, planner_blocks=2, line_rate=3.0)
    found = fit(rows(0.04, 3000.0), slow)
    assert "finish: " in found.warning and "% of the time" in found.warning
    assert found.tolerance > 0
