"""What one cutter may do in one material on one machine."""

from dataclasses import replace

import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.machine import Machine, Material, cutting

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
