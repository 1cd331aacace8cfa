from math import atan, degrees, hypot, sqrt

import numpy as np
import pytest

from relieffab.panel.draft import check_draft
from relieffab.stock import Stock


def pit(steep, norm, pitch=0.1, half=30):
    """Heights of a pit that falls by `steep` towards its middle, 2 mm in radius."""
    y, x = np.mgrid[-half : half + 1, -half : half + 1] * pitch
    return -steep * np.maximum(0.0, 2.0 - norm(x, y))


def test_a_cone_has_the_draft_of_its_side(make_relief):
    relief = make_relief(pit(5.0, np.hypot), pitch=0.1)
    draft = 90 - degrees(atan(5.0))
    stock = Stock(8, 8, 12)
    # A lattice is steeper at its tip, along the pixels' diagonal, by up to the root of two.
    tip = 90 - degrees(atan(5.0 * sqrt(2)))
    assert check_draft(relief, stock, tip).ok
    assert check_draft(relief, stock, draft - 1).share < 0.01
    found = check_draft(relief, stock, draft + 1)
    assert tip <= found.least < draft
    assert not found.ok
    assert found.share > 0.9
    assert found.where == pytest.approx((4, 4), abs=0.1)


def test_a_pyramid_is_exact_to_the_triangle(make_relief):
    """Where the lattice's diagonal crosses the pyramid's edge, half a pixel falls both ways."""
    k, across = 3.0, 2 * 20
    relief = make_relief(pit(k, lambda x, y: np.maximum(abs(x), abs(y))), pitch=0.1)
    found = check_draft(relief, Stock(8, 8, 12), 90 - degrees(atan(k)) - 0.1)
    assert found.least == pytest.approx(90 - degrees(atan(k * sqrt(2))))
    # All triangles but those along that edge fall by k: half of its pixels' are steep, half
    # flat; and two of the flat ones lie on the face, not below.
    steep, plain = hypot(1, k * sqrt(2)), hypot(1, k)
    triangles = 2 * across**2
    walls = (triangles - 2 * across) * plain + across * steep
    assert found.share == pytest.approx(across * steep / (walls + across - 2))
    assert found.walls == pytest.approx(across * steep / walls)
    assert found.where[0] + found.where[1] == pytest.approx(8.0, abs=0.2) or (
        found.where[0] == pytest.approx(found.where[1], abs=0.2)
    )


def test_a_relief_that_ends_upright_has_no_draft(make_relief):
    relief = make_relief(np.full((9, 13), -1.0), rim=1.0)
    found = check_draft(relief, Stock(14, 10, 3), 3.0)
    assert (found.least, found.walls) == (0.0, 1.0)
    assert found.share == pytest.approx(40 / (40 + 96))
    open_sided = check_draft(make_relief(np.full((9, 13), -1.0), rim=0.0), Stock(12, 8, 3))
    assert (open_sided.least, open_sided.share, open_sided.walls) == (90.0, 0.0, 0.0)


def test_nothing_sunk_comes_free(make_relief):
    found = check_draft(make_relief(np.zeros((5, 5))), Stock(6, 6, 3))
    assert found.ok
    assert (found.least, found.where, found.share) == (90.0, None, 0.0)
