import math
from itertools import pairwise

import pytest

from relieffab.grbl.simulator.arcs import centre_from_radius, check_ends, chords
from relieffab.grbl.simulator.words import Refused

XY = (0, 1, 2)


def arc(end, offset, clockwise):
    return list(chords((10.0, 0.0, 0.0), end, offset, XY, clockwise=clockwise, tolerance=0.002))


@pytest.mark.parametrize(
    ("end", "clockwise", "sweep"),
    [((0.0, 10.0, 0.0), False, 90), ((0.0, 10.0, 0.0), True, 270), ((10.0, 0.0, 5.0), True, 360)],
)
def test_chords_stay_within_the_tolerance(end, clockwise, sweep):
    points = [(10.0, 0.0, 0.0), *arc(end, (-10.0, 0.0), clockwise)]
    assert points[-1] == end
    radii = [math.hypot(x, y) for x, y, _ in points]
    assert radii == pytest.approx([10.0] * len(points))
    middles = [math.dist((0, 0), ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2))
               for a, b in pairwise(points)]  # fmt: skip
    assert 10.0 - min(middles) <= 0.0021
    length = sum(math.dist(a[:2], b[:2]) for a, b in pairwise(points))
    assert length == pytest.approx(10 * math.radians(sweep), rel=1e-3)


@pytest.mark.parametrize("clockwise", [True, False])
@pytest.mark.parametrize("radius", [10.0, -10.0])
def test_the_centre_is_equally_far_from_both_ends(radius, clockwise):
    cu, cv = centre_from_radius(8.0, 6.0, radius, clockwise=clockwise)
    assert math.hypot(cu, cv) == pytest.approx(10)
    assert math.hypot(8 - cu, 6 - cv) == pytest.approx(10)
    right_of_the_chord = 8.0 * cv - 6.0 * cu < 0
    assert right_of_the_chord == (clockwise == (radius > 0))


def test_impossible_arcs_are_refused():
    with pytest.raises(Refused, match="34"):
        centre_from_radius(30.0, 0.0, 10.0, clockwise=True)
    with pytest.raises(Refused, match="33"):
        check_ends((10.0, 0.0), (0.0, 10.2))
    check_ends((10.0, 0.0), (0.0, 10.004))
