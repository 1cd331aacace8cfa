"""Profiles of every shape, and the shapes that cannot be."""

import math

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError

COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 800.0, "plunge": 200.0, "rpm": 9000.0}


def make(shape, diameter=2.0, **rest):
    return Cutter("c", shape, diameter, **{**COMMON, **rest})


def test_flat_is_flat_up_to_its_radius():
    assert make("flat").profile([0, 0.5, 1.0, 1.01]).tolist() == [0, 0, 0, math.inf]


def test_ball_is_a_circle():
    r = np.linspace(0, 1, 11)
    assert np.allclose(make("ball").profile(r), 1 - np.sqrt(1 - r**2))


def test_bull_is_a_flat_then_a_circle():
    bull = make("bull", corner_radius=0.25)
    assert bull.flat_radius == 0.75
    assert np.allclose(bull.profile([0.7, 0.75 + 0.15, 1.0]), [0, 0.05, 0.25])


def test_vee_is_a_cone_from_its_tip():
    vee = make("vee", angle=90, tip_diameter=0.2)
    assert np.allclose(vee.profile([0.05, 0.1, 0.5, 1.0]), [0, 0, 0.4, 0.9])


def test_tapered_ball_meets_its_cone_without_a_step_or_a_bend():
    cutter = make("tapered ball", angle=20, tip_diameter=0.6)
    half = math.radians(10)
    assert cutter.arc_end == pytest.approx(0.3 * math.cos(half))
    end, tiny = cutter.arc_end, 1e-7
    below, at, above = cutter.profile([end - tiny, end, end + tiny])
    assert at == pytest.approx(0.3 * (1 - math.sin(half)))
    assert (above - at) / tiny == pytest.approx(cutter.flank, rel=1e-4)
    assert (at - below) / tiny == pytest.approx(cutter.flank, rel=1e-4)


LEAF = ((0, 0), (0.2, 0), (0.6, 0.3), (1.0, 1.5))


def test_a_form_follows_its_points():
    form = make("form", points=LEAF)
    assert np.allclose(form.profile([0.1, 0.4, -0.8, 1.0]), [0, 0.15, 0.9, 1.5])
    assert form.profile(1.01) == math.inf
    assert form.flat_radius == 0.2
    with pytest.raises(InputError, match="no one flank"):
        _ = form.flank


def test_points_may_be_lists_as_a_report_holds_them():
    assert make("form", points=[list(p) for p in LEAF]) == make("form", points=LEAF)


def test_the_shank_is_as_wide_as_the_cutter_unless_told():
    assert make("ball").shank_radius == 1.0
    assert make("ball", shank_diameter=3.0).shank_radius == 1.5


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"shape": "bal"}, "did you mean ball"),
        ({"shape": "flat", "diameter": 0.0}, "diameter cannot be 0"),
        ({"shape": "flat", "feed": math.nan}, "feed cannot be nan"),
        ({"shape": "vee"}, "included angle"),
        ({"shape": "tapered ball", "angle": 10}, "diameter of its ball"),
        ({"shape": "vee", "angle": 30, "tip_diameter": 2.0}, "flat tip"),
        ({"shape": "bull", "corner_radius": 1.0}, "corner radius"),
        ({"shape": "ball", "angle": 30}, "a ball cutter has no angle"),
        ({"shape": "flat", "corner_radius": 0.2}, "a flat cutter has no corner_radius"),
        ({"shape": "flat", "points": LEAF}, "a flat cutter has no points"),
        ({"shape": "form"}, "convex profile"),
        ({"shape": "form", "points": LEAF[1:]}, "convex profile"),
        ({"shape": "form", "points": LEAF[:-1]}, "convex profile"),
        ({"shape": "form", "points": (*LEAF[:-1], (1.0, 0.4))}, "convex profile"),
        ({"shape": "form", "points": ((0, 0), (1.0, math.nan))}, "convex profile"),
        ({"shape": "flat", "shank_diameter": -1.0}, "shank has no such diameter"),
        ({"shape": "flat", "stickout": 8.0}, "into the collet"),
    ],
)
def test_what_is_no_cutter_is_refused(values, word):
    with pytest.raises(InputError, match=word):
        make(**values)
