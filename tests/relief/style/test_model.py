import re

import numpy as np
import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.relief.style.chisels import CHISELS, PECK
from relieffab.relief.style.model import FINEST, Style, mark_width


def test_what_is_asked_goes_before_the_chisels_own():
    tool = profiles.cutter("ball-3.175")
    style = Style("gouge", spacing=2.0, depth=0.3, cutter=tool)
    assert (style.chisel.spacing, style.chisel.depth, style.tool) == (2.0, 0.3, tool)
    assert style.chisel.length == CHISELS["gouge"].length


def test_pecks_take_nothing_from_the_figure():
    style = Style(ground="pecked")
    assert style.headroom == 0 and style.pecked and not style.plain
    assert style.chisel == PECK
    assert Style().plain


def test_width_of_marks():
    assert mark_width(profiles.cutter("ball-2"), 0.2) == pytest.approx(
        2 * np.sqrt(1 - 0.64), rel=1e-3
    )
    assert mark_width(profiles.cutter("vee-90"), 0.3) == pytest.approx(0.8, rel=3e-3)
    assert mark_width(profiles.cutter("flat-2"), 0.1) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"marks": "gauge"}, "no style of that name"),
        ({"ground": "rough"}, "no style of that name"),
        ({"spacing": 0.0}, "spacing cannot be 0"),
        ({"depth": -1.0}, "depth cannot be -1"),
        ({"depth": np.nan}, "depth cannot be nan"),
        ({"direction": np.inf}, "direction is not a number"),
    ],
)
def test_what_is_no_style(wrong, says):
    with pytest.raises(InputError, match=says):
        Style(**{"marks": "gouge", **wrong})


def test_the_least_spacing_named_is_enough():
    pitch = 40 / 96
    with pytest.raises(InputError, match="closer together") as refused:
        Style("gouge", spacing=1.0).check(3.0, pitch)
    least = float(re.search(r"expected: ([\d.]+) mm", str(refused.value))[1])
    assert FINEST * pitch <= least < FINEST * pitch + 0.01
    with pytest.raises(InputError, match="finer than"):
        Style("gouge", spacing=least).check(3.0, pitch)


def test_marks_too_deep_or_too_fine_are_refused():
    style = Style("gouge", spacing=2.0, depth=0.3)
    style.check(0.6, 0.1)
    with pytest.raises(InputError, match="too much of the relief's depth"):
        style.check(0.59, 0.1)
    with pytest.raises(InputError, match="closer together"):
        Style("gouge", spacing=0.24).check(3.0, 0.1)
    width = mark_width(style.tool, 0.3)
    style.check(3.0, 0.99 * width / FINEST)
    with pytest.raises(InputError, match="finer than the relief's pixels"):
        style.check(3.0, 1.01 * width / FINEST)
