import numpy as np
import pytest

from relieffab.relief.style.field import (
    HABIT,
    bending,
    fixed_field,
    form_field,
    sharpest,
    smoothest,
)


def angles(field):
    return np.degrees(np.angle(field) / 2)


def off(field, angle):
    """Degrees between a line field and a direction, 0 to 90."""
    return np.abs((angles(field) - angle + 90) % 180 - 90)


def inner(ground):
    x, y = np.meshgrid(*ground.layers.grid.node_axes())
    return np.hypot(x - 12, y - 9) < 6


def test_a_cylinder_is_stroked_along_and_hatched_around(cylinder):
    clear = cylinder.layers.mask
    along = form_field(cylinder.layers, clear, around=False)[inner(cylinder)]
    around = form_field(cylinder.layers, clear, around=True)[inner(cylinder)]
    assert off(around, 20.0).max() < 1.0
    assert off(along, 110.0).max() < 1.0
    np.testing.assert_allclose(np.abs(along), 1.0, atol=1e-6)


def test_bending_of_a_cylinder_is_its_curvature_across(cylinder):
    weight, tensor = bending(cylinder.layers, cylinder.layers.mask)
    turn = np.radians(20.0)
    c, s = np.cos(turn), np.sin(turn)
    known = weight > 0
    for part, want in zip(tensor, (c * c, s * s, c * s), strict=True):
        np.testing.assert_allclose(part[known], 0.1 * want, atol=1e-6)


def test_only_what_bends_one_way_has_a_direction_of_its_own():
    cylinder, bowl, saddle, plane = (
        np.array(t) for t in ([1, 0, 0], [1, 1, 0], [1, -1, 0], [0, 0, 0])
    )
    assert abs(sharpest(cylinder)) == pytest.approx(1.0, abs=1e-3)
    assert sharpest(bowl) == sharpest(saddle) == sharpest(plane) == 0
    # A hollow cylinder bends most the same way.
    assert sharpest(-cylinder) == sharpest(cylinder)


def test_where_the_form_says_nothing_there_is_the_habit(level, ball):
    for ground in (level, ball):
        field = form_field(ground.layers, ground.layers.mask, around=True)[inner(ground)]
        assert np.median(off(field, HABIT[0])) < 5.0


def test_directions_do_not_pass_a_closed_cell():
    wanted = np.zeros((9, 21), complex)
    wanted[:, :3], wanted[:, 18:] = 1.0, -1.0
    open_ = np.ones((9, 21), bool)
    open_[:, 10] = False
    parted = smoothest(wanted, open_, 20.0)
    assert off(parted[:, :10], 0.0).max() < 5
    assert off(parted[:, 11:], 90.0).max() < 5
    joined = smoothest(wanted, np.ones_like(open_), 20.0)
    assert off(joined[:, :10], 0.0).max() > 10


def test_the_smoothest_field_solves_its_equation():
    """A twin in dense linear algebra."""
    rng = np.random.default_rng(3)
    wanted = rng.normal(size=(4, 5)) + 1j * rng.normal(size=(4, 5))
    count, calm = 20, 1.7
    laplacian = np.zeros((count, count))
    for i in range(4):
        for j in range(5):
            for a, b in ((i, j + 1), (i + 1, j)):
                if a < 4 and b < 5:
                    k, m = 5 * i + j, 5 * a + b
                    laplacian[k, k] += 1
                    laplacian[m, m] += 1
                    laplacian[k, m] -= 1
                    laplacian[m, k] -= 1
    angle, pull = HABIT
    rhs = wanted.ravel() + pull * np.exp(2j * np.radians(angle))
    found = np.linalg.solve(np.diag(np.abs(wanted.ravel()) + pull) + calm**2 * laplacian, rhs)
    want = (found / np.abs(found)).reshape(4, 5)
    np.testing.assert_allclose(smoothest(wanted, np.ones((4, 5), bool), calm), want, atol=1e-9)


def test_where_all_is_closed_there_is_the_habit():
    nowhere = np.zeros((3, 4), bool)
    np.testing.assert_allclose(angles(smoothest(np.ones((3, 4), complex), nowhere, 2.0)), HABIT[0])
    alone = nowhere.copy()
    alone[1, 1] = True
    np.testing.assert_allclose(off(smoothest(np.ones((3, 4), complex), alone, 2.0), 0.0), 0, atol=1)


def test_a_fixed_direction_is_the_same_everywhere():
    np.testing.assert_allclose(angles(fixed_field(30.0, (3, 4))), 30.0)
