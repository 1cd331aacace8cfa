"""Outlines against the profiles they stand for, and parallel curves against circles."""

import math

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.toolpath.outline import (
    R1,
    height_at,
    outline_of,
    radius_at,
    slope_at,
    smooth_below,
    touch,
    touch_last,
)

COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 800.0, "plunge": 200.0, "rpm": 9000.0}
CUTTERS = [
    Cutter("flat", "flat", 1.5, **COMMON),
    Cutter("ball", "ball", 1.5, **COMMON),
    Cutter("bull", "bull", 1.6, corner_radius=0.3, **COMMON),
    Cutter("vee", "vee", 2.0, angle=60, tip_diameter=0.2, **COMMON),
    Cutter("sharp vee", "vee", 2.0, angle=90, **COMMON),
    Cutter("tapered", "tapered ball", 2.0, angle=20, tip_diameter=0.6, **COMMON),
    Cutter("form", "form", 2.0, points=((0, 0), (0.2, 0.05), (0.6, 0.3), (1, 1.5)), **COMMON),
]
each = pytest.mark.parametrize("cutter", CUTTERS, ids=lambda cutter: cutter.name)


@each
def test_an_outline_is_the_profile(cutter):
    outline = outline_of(cutter)
    r = np.linspace(0, cutter.radius, 101)
    assert outline[-1, R1] == pytest.approx(cutter.radius)
    assert np.allclose([height_at(outline, a) for a in r], cutter.profile(r))


@each
def test_a_grown_outline_is_where_circles_around_the_profile_reach(cutter):
    by = 0.2
    outline = outline_of(cutter, by)
    assert outline[-1, R1] == pytest.approx(cutter.radius + by)
    r = np.linspace(-cutter.radius, cutter.radius, 20001)
    z = cutter.profile(r)
    for away in np.linspace(0, cutter.radius + by, 40)[:-1]:
        near = np.abs(r - away) <= by
        reach = (z[near] - np.sqrt(by**2 - (r[near] - away) ** 2)).min() + by
        assert height_at(outline, away) == pytest.approx(reach, abs=2e-4)


@each
def test_radius_undoes_height_where_the_outline_climbs(cutter):
    outline = outline_of(cutter, 0.05)
    for r in np.linspace(0, outline[-1, R1], 30)[1:-1]:
        z = height_at(outline, r)
        if z > 0:
            assert radius_at(outline, z) == pytest.approx(r, abs=1e-6)
    assert radius_at(outline, 99.0) == outline[-1, R1]


@each
def test_a_plane_touches_where_the_outline_is_as_steep(cutter):
    outline = outline_of(cutter, 0.01)
    assert math.isinf(smooth_below(outline))
    r = np.linspace(0, outline[-1, R1], 4001)
    z = np.array([height_at(outline, a) for a in r])
    for slope in (0.0, 0.3, 1.0, 4.0):
        gap = slope * r - z
        near, far = touch(outline, slope), touch_last(outline, slope)
        assert near <= far
        for a in (near, far):
            assert slope * a - height_at(outline, a) == pytest.approx(gap.max(), abs=1e-4)


def test_slopes_of_pieces():
    ball = outline_of(CUTTERS[1])
    assert slope_at(ball, 0, 0.75 * math.sin(0.4)) == pytest.approx(math.tan(0.4))
    assert math.isinf(slope_at(ball, 0, 0.75))


def test_corners_end_what_is_smooth():
    assert [smooth_below(outline_of(cutter)) for cutter in CUTTERS[:2]] == [0.0, math.inf]
    assert smooth_below(outline_of(CUTTERS[5])) == pytest.approx(CUTTERS[5].flank)
