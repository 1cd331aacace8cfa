from math import radians, tan

import pytest

from relieffab.errors import InputError
from relieffab.panel.tongues import LENGTH, TAPER, WIDTH, layout, prism, tongue_height


def test_the_fewest_parts_that_fit():
    assert layout((300.0, 20.0), (220.0, 220.0), 0.2) == (1, 2)
    assert layout((430.0, 430.0), (220.0, 220.0), 0.2) == (2, 2)
    # Two halves fit the bed, but not with a tongue.
    assert layout((430.1, 400.0), (220.0, 220.0), 0.2) == (2, 3)


def test_tongues_keep_below_the_relief():
    assert tongue_height(12.0, 9.0, 0.2) == 4.0
    assert tongue_height(12.0, 4.0, 0.2) == pytest.approx(2.8)
    with pytest.raises(InputError, match="too thin for tongues"):
        tongue_height(12.0, 2.1, 0.2)
    with pytest.raises(InputError, match="3 mm or more"):
        tongue_height(2.9, 2.9, 0.0)


def test_a_tongue_tapers_from_the_seam():
    tongue = prism((30.0, 20.0), False, 3.0, None)
    x0, y0, z0, x1, y1, z1 = tongue.bounding_box()
    assert (x1, z0, z1) == pytest.approx((30 + LENGTH, 0, 3))
    seam = tongue.trim_by_plane((1.0, 0.0, 0.0), 30.0).bounding_box()
    assert (seam[1], seam[4]) == pytest.approx((20 - WIDTH / 2, 20 + WIDTH / 2))
    tip = tongue.trim_by_plane((1.0, 0.0, 0.0), x1 - 1e-3).bounding_box()
    assert tip[4] - tip[1] == pytest.approx(WIDTH - 2 * LENGTH * tan(radians(TAPER)), abs=1e-2)
    turned = prism((20.0, 30.0), True, 3.0, None).bounding_box()
    assert turned == pytest.approx((y0, x0, z0, y1, x1, z1))
