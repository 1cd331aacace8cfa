"""Outlines against the profiles they stand for, and parallel curves against circles."""

import math

import numpy as np
import pytest

from relieffab.toolpath.outline import (
    R1,
    bulge_of,
    height_at,
    outline_of,
    radius_at,
    slope_at,
    smooth_below,
    touch,
    touch_last,
)


def test_an_outline_is_the_profile(every_cutter):
    outline = outline_of(every_cutter)
    r = np.linspace(0, every_cutter.radius, 101)
    assert outline[-1, R1] == pytest.approx(every_cutter.radius)
    assert np.allclose([height_at(outline, a) for a in r], every_cutter.profile(r))


def test_a_grown_outline_is_where_circles_around_the_profile_reach(every_cutter):
    by = 0.2
    outline = outline_of(every_cutter, by)
    assert outline[-1, R1] == pytest.approx(every_cutter.radius + by)
    r = np.linspace(-every_cutter.radius, every_cutter.radius, 20001)
    z = every_cutter.profile(r)
    for away in np.linspace(0, every_cutter.radius + by, 40)[:-1]:
        near = np.abs(r - away) <= by
        reach = (z[near] - np.sqrt(by**2 - (r[near] - away) ** 2)).min() + by
        assert height_at(outline, away) == pytest.approx(reach, abs=2e-4)


def test_radius_undoes_height_where_the_outline_climbs(every_cutter):
    outline = outline_of(every_cutter, 0.05)
    for r in np.linspace(0, outline[-1, R1], 30)[1:-1]:
        z = height_at(outline, r)
        if z > 0:
            assert radius_at(outline, z) == pytest.approx(r, abs=1e-6)
    assert radius_at(outline, 99.0) == outline[-1, R1]


def test_a_plane_touches_where_the_outline_is_as_steep(every_cutter):
    outline = outline_of(every_cutter, 0.01)
    assert math.isinf(smooth_below(outline))
    r = np.linspace(0, outline[-1, R1], 4001)
    z = np.array([height_at(outline, a) for a in r])
    for slope in (0.0, 0.3, 1.0, 4.0):
        gap = slope * r - z
        near, far = touch(outline, slope), touch_last(outline, slope)
        assert near <= far
        for a in (near, far):
            assert slope * a - height_at(outline, a) == pytest.approx(gap.max(), abs=1e-4)


def test_slopes_of_pieces(cutters):
    ball = outline_of(cutters["ball"])
    assert slope_at(ball, 0, 0.75 * math.sin(0.4)) == pytest.approx(math.tan(0.4))
    assert math.isinf(slope_at(ball, 0, 0.75))


def test_corners_end_what_is_smooth(cutters):
    assert [smooth_below(outline_of(cutters[name])) for name in ("flat", "ball")] == [0.0, math.inf]
    tapered = cutters["tapered ball"]
    assert smooth_below(outline_of(tapered)) == pytest.approx(tapered.flank)


def test_no_higher_parabola_lies_below_the_outline(every_cutter):
    outline = outline_of(every_cutter)
    r = np.linspace(0, every_cutter.radius, 2001)[1:]
    ratio = every_cutter.profile(r) / r**2
    assert (bulge_of(outline) <= ratio).all()
    assert bulge_of(outline) >= 0.999 * ratio.min()
