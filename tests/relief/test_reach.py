import numba
import numpy as np
import pytest
from scipy import ndimage

from relieffab.cutter import Cutter
from relieffab.relief.reach import ball, closing, tip

PITCH = 0.1


def cutter(shape, diameter, **more):
    return Cutter("c", shape, diameter, 9.0, 1.0, 500.0, 200.0, 10000.0, **more)


CUTTERS = {
    "ball": cutter("ball", 1.0),
    "flat": cutter("flat", 0.7),
    "bull": cutter("bull", 1.2, corner_radius=0.3),
    "vee": cutter("vee", 3.0, angle=60.0, tip_diameter=0.1),
    "tapered ball": cutter("tapered ball", 2.0, angle=20.0, tip_diameter=0.5),
}


def twin(heights, pitch, profile, reach):
    """The same by SciPy, the whole cutter, on a field that the face surrounds."""
    side = np.arange(-reach, reach + 1) * pitch
    c = profile(np.hypot(side[:, None], side))
    inside = np.isfinite(c)
    shape = -np.where(inside, c, 0.0)
    wide = np.pad(heights, 2 * reach)
    lowest = ndimage.grey_dilation(wide, footprint=inside, structure=shape)
    left = ndimage.grey_erosion(lowest, footprint=inside, structure=shape)
    return left[2 * reach : -2 * reach, 2 * reach : -2 * reach]


@pytest.fixture(scope="module")
def rough():
    """Forms, fine roughness, a slot and a flat part; some of it at the grid's edge."""
    rng = np.random.default_rng(5)
    h = ndimage.gaussian_filter(rng.normal(size=(83, 151)), 5.0) * 12
    h += 0.2 * rng.normal(size=h.shape)
    h[20:23, 10:80] -= 1.5
    h[60:, 100:] = 1.0
    return np.clip(h - 0.5, -3.0, 0.0)


@pytest.mark.parametrize("name", CUTTERS)
def test_it_is_the_closing_of_mathematical_morphology(rough, name):
    one = CUTTERS[name]
    reach = int(one.radius / PITCH) + 1
    found = closing(rough, PITCH, one.profile)
    np.testing.assert_allclose(found, twin(rough, PITCH, one.profile, reach), atol=1e-12)
    assert (found >= rough).all()
    assert found.max() <= 0
    assert (found > rough + 0.05).any()


def test_what_was_closed_stays_closed(rough):
    once = closing(rough, PITCH, ball(0.4))
    np.testing.assert_allclose(closing(once, PITCH, ball(0.4)), once, atol=1e-12)


def test_a_ball_is_the_ball_cutter(rough):
    same = closing(rough, PITCH, CUTTERS["ball"].profile)
    np.testing.assert_allclose(closing(rough, PITCH, ball(0.5)), same, atol=1e-9)


def test_a_slot_is_bridged_by_a_ball_and_closed_by_a_flat():
    pitch, radius = 0.05, 0.25
    heights = np.zeros((41, 41))
    heights[:, 18:23] = -1.0
    sag = radius - np.sqrt(radius**2 - 0.15**2)
    assert closing(heights, pitch, ball(radius))[20, 20] == pytest.approx(-sag, abs=1e-9)
    assert (closing(heights, pitch, cutter("flat", 0.5).profile) == 0).all()


def test_a_cutter_that_fits_leaves_nothing():
    heights = np.zeros((61, 61))
    heights[10:50, 10:50] = -1.0
    assert (closing(heights, PITCH, cutter("flat", 2.0).profile)[20:40, 10:50] == -1).all()
    i, j = np.indices(heights.shape) - 30
    bowl = np.minimum(0.02 * (i**2 + j**2) * PITCH - 1.0, 0.0)
    np.testing.assert_allclose(closing(bowl, PITCH, ball(0.5)), bowl, atol=0.01)


def test_the_face_goes_on_beyond_the_grid():
    heights = np.full((30, 30), -1.0)
    found = closing(heights, PITCH, ball(0.5))
    assert found[0, 15] > -0.9
    assert found[15, 15] == -1.0


def test_nothing_to_do():
    flat = np.zeros((9, 9))
    assert closing(flat, PITCH, ball(1.0)) is flat
    sunken = flat - 1.0
    assert closing(sunken, PITCH, ball(0.05)) is sunken


def test_heights_are_not_written_to(rough):
    before = rough.copy()
    closing(rough, PITCH, ball(0.5))
    np.testing.assert_array_equal(rough, before)
    frozen = rough.copy()
    frozen.flags.writeable = False
    assert closing(frozen, PITCH, ball(0.5)).flags.writeable


def test_threads_do_not_change_the_answer(rough):
    before = numba.get_num_threads()
    found = closing(rough, PITCH, ball(0.7))
    try:
        numba.set_num_threads(1)
        np.testing.assert_array_equal(closing(rough, PITCH, ball(0.7)), found)
    finally:
        numba.set_num_threads(before)


def test_only_the_part_of_a_cutter_as_tall_as_the_relief_counts():
    offsets, drop = tip(CUTTERS["vee"].profile, PITCH, 0.5, 100)
    assert drop.max() <= 0.5
    assert (np.diff(drop) >= 0).all()
    assert np.hypot(*offsets.T).max() * PITCH <= 0.05 + 0.5 * np.tan(np.radians(30)) + 1e-9
    assert len(tip(ball(5.0), PITCH, 3.0, 4)[0]) == 9 * 9 - 1
