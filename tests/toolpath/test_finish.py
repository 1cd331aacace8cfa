"""The stepover that a scallop height asks for."""

import pytest

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.toolpath.finish import scallop_stepover


def test_ridges_of_a_ball_have_the_height_asked_for():
    ball = profiles.cutter("ball-1")
    step = scallop_stepover(ball, 0.01)
    ridge = ball.radius - (ball.radius**2 - (step / 2) ** 2) ** 0.5
    assert ridge == pytest.approx(0.01, rel=0.02)


def test_the_stepover_has_bounds():
    tiny = Cutter("c", "ball", 0.1, 9.0, 1.0, 800.0, 200.0, 9000.0)
    assert scallop_stepover(tiny, 0.001) == 0.02
    assert scallop_stepover(tiny, 9.0) == pytest.approx(0.1)
    assert scallop_stepover(profiles.cutter("vee-30")) == 0.08
    assert scallop_stepover(profiles.cutter("flat-6")) == pytest.approx(0.6)
