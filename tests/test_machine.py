"""What one cutter may do in one material on one machine."""

from dataclasses import replace
from math import pi

import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.machine import Machine, Material, Rotary, Use, cutting, turning

CUTTER = Cutter("f", "flat", 3.0, 9.0, 1.0, 1000.0, 300.0, 12000.0)
MACHINE = Machine(
    name="m",
    title="M",
    travel=(200.0, 150.0, 40.0),
    max_rate=(900.0, 800.0, 250.0),
    acceleration=(30.0, 30.0, 30.0),
    spindle=(5000.0, 10000.0),
    spindle_max_setting=1000.0,
)
STONE = Material("s", "S", feed=0.5, stepdown=0.1, rpm=0.25)


def test_feeds_are_capped_by_the_slowest_axis():
    use = cutting(CUTTER, Material("w", "W", feed=1, stepdown=1), MACHINE)
    assert (use.feed, use.plunge, use.rpm, use.stepdown) == (800, 250, 10000, 1)


def test_material_scales_and_the_spindle_has_a_slowest_speed():
    use = cutting(CUTTER, STONE, MACHINE)
    assert (use.feed, use.plunge, use.rpm) == (500, 150, 5000)
    assert use.stepdown == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"travel": (200.0, 0.0, 40.0)}, "travel must be more than 0"),
        ({"max_rate": (1.0, 1.0, -1.0)}, "max_rate"),
        ({"acceleration": (0.0, 1.0, 1.0)}, "acceleration"),
        ({"safe_height": 0.0}, "safe height"),
        ({"spindle": (9000.0, 8000.0)}, "out of order"),
        ({"spindle": (0.0, 0.0)}, "out of order"),
    ],
)
def test_impossible_machines_are_refused(values, word):
    with pytest.raises(InputError, match=word):
        replace(MACHINE, **values)


@pytest.mark.parametrize("values", [{"feed": 0}, {"stepdown": -1}, {"rpm": 3}])
def test_impossible_materials_are_refused(values):
    with pytest.raises(InputError, match=f"factor {next(iter(values))}"):
        replace(STONE, **values)


def known(**values):
    use = {"cutter": "f", "feed": 700.0, "source": "a chart", "rpm": 9000.0} | values
    return Material("w", "W", feed=0.5, stepdown=0.5, source="a rule", use=(Use(**use),))


def test_what_is_known_of_a_cutter_comes_before_the_factors():
    use = cutting(CUTTER, known(stepdown=2.0, plunge=150.0), MACHINE)
    assert (use.feed, use.plunge, use.rpm, use.stepdown) == (700, 150, 9000, 2)
    assert use.source == "a chart" and use.verified
    use = cutting(CUTTER, known(), MACHINE)
    assert (use.plunge, use.stepdown) == (150, 0.5)
    other = cutting(replace(CUTTER, name="g"), known(), MACHINE)
    assert (other.feed, other.source, other.verified) == (500, "a rule", False)


def test_what_is_known_of_one_machine_comes_first():
    assert cutting(CUTTER, known(machines=("else",)), MACHINE).feed == 500
    any_one, here = known().use[0], known(machines=("m",), feed=600.0).use[0]
    both = replace(known(), use=(any_one, here))
    assert cutting(CUTTER, both, MACHINE).feed == 600
    assert cutting(CUTTER, both, replace(MACHINE, name="n")).feed == 700


def test_a_slower_spindle_keeps_the_chip():
    assert cutting(CUTTER, known(rpm=20000.0), MACHINE).feed == 350
    assert cutting(CUTTER, known(feed=2000.0), MACHINE).feed == 800


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"feed": 0.0}, "out of range"),
        ({"rpm": -1.0}, "out of range"),
        ({"source": " "}, "no source"),
    ],
)
def test_impossible_uses(values, word):
    with pytest.raises(InputError, match=word):
        known(**values)


ROTARY = Rotary(3600.0, 180.0, 100.0)


def test_a_rotary_axis_is_a_y_that_goes_round_the_face():
    found = turning(replace(MACHINE, rotary=ROTARY), 40.0)
    turn = 2 * pi * 40.0
    assert found.max_rate == (900.0, pytest.approx(10 * turn), 250.0)
    assert found.acceleration == (30.0, pytest.approx(turn / 2), 30.0)
    assert found.travel[1] >= turn
    assert found.travel[::2] == MACHINE.travel[::2]


def test_without_a_rotary_axis_or_room_there_is_no_turning():
    with pytest.raises(InputError, match="has no rotary axis"):
        turning(MACHINE, 40.0)
    with pytest.raises(InputError, match="too thick for the rotary axis"):
        turning(replace(MACHINE, rotary=ROTARY), 50.1)
    with pytest.raises(InputError, match="max_rate of 0"):
        Rotary(0.0, 180.0, 100.0)
