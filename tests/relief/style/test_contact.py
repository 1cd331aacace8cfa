import numpy as np
import pytest

from relieffab import profiles
from relieffab.relief.reach import ball, lowest_tips
from relieffab.relief.style.contact import axes, guarded_tips, kept_up, leaning

PITCH = 0.1


def test_on_a_dome_the_axis_stands_further_out_by_the_tips_share():
    """Radii R and S, touching at s from the middle: the axis stands at s (1 + R/S)."""
    row, col = np.indices((121, 121)) * PITCH - 6.0
    heights = np.sqrt(15.0**2 - row**2 - col**2) - 15.5
    lean = leaning(heights, PITCH, np.ones(heights.shape, bool))
    places = np.array([[60.0, 60.0], [60.0, 90.0], [40.0, 75.0]])
    moved = axes(places, lean, 2.0 / PITCH)
    np.testing.assert_allclose(moved - 60, (places - 60) * (1 + 2.0 / 15.0), atol=0.2)


@pytest.mark.parametrize("slope", [0.0, 0.5, 1.0])
def test_there_the_lowest_tip_touches_the_place(slope):
    radius = 1.0
    row = np.indices((161, 161))[0] * PITCH
    heights = slope * row - 20.0
    lean = leaning(heights, PITCH, np.ones(heights.shape, bool))
    (axis,) = axes(np.array([[80.0, 80.0]]), lean, radius / PITCH)
    tip = lowest_tips(heights, PITCH, ball(radius))[round(axis[0]), 80]
    # The middle is one radius above the tip, and one from the place touched.
    middle = np.array([axis[0] * PITCH, tip + radius])
    assert np.hypot(*(middle - [8.0, heights[80, 80]])) == pytest.approx(radius, abs=0.05)


def test_walls_do_not_lean_on_what_is_beside_them():
    heights = np.full((60, 60), -1.0)
    heights[:, 30:] = -3.0
    clear = np.ones(heights.shape, bool)
    clear[:, 29:32] = False
    assert np.abs(leaning(heights, PITCH, clear)[:, clear]).max() == 0


def test_the_walls_of_a_trench_keep_a_cutter_up():
    """By the height of its flank at the rims, and by a mark's depth where that is no part of it."""
    heights = np.full((81, 81), -0.8)
    heights[:33], heights[48:] = 0.0, 0.0
    places = np.array([[40.0, 20.0], [40.0, 60.0], [10.0, 40.0]])
    # Rims are 0.8 mm off, where the vee's flank is 0.7 mm high, beyond its mark; the ball's 0.4.
    for name, deep, kept in (("vee-90", 0.1, 0.8 - 0.7 + 0.1), ("ball-2", 0.1, 0.8 - 0.4)):
        cutter = profiles.cutter(name)
        tips = guarded_tips(heights, np.ones(heights.shape, bool), PITCH, cutter, deep)
        found = kept_up(heights, tips, places, places, cutter, PITCH)
        np.testing.assert_allclose(found, [kept, kept, 0.0], atol=1e-6)


def test_ground_that_is_not_clear_is_not_touched():
    """A line as far off as a mark so deep is half wide lets it be so deep, and no nearer one."""
    cutter, deep = profiles.cutter("vee-90"), 0.3
    heights, clear = np.full((81, 81), -1.0), np.ones((81, 81), bool)
    clear[:, 40] = False
    guard = guarded_tips(heights, clear, PITCH, cutter, deep)
    kept = kept_up(heights, guard, *[np.array([[40.0, 42.0], [40.0, 44.0]])] * 2, cutter, PITCH)
    np.testing.assert_allclose(kept, deep - cutter.profile([0.2, 0.4]).clip(0, deep), atol=1e-9)
