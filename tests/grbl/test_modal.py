import pytest

from relieffab.grbl.modal import Modal


def test_grbl_starts_so():
    assert Modal().quiet
    assert (Modal().scale, Modal().relative) == (1.0, False)


@pytest.mark.parametrize(
    ("code", "name"),
    [(2, "motion"), (18, "plane"), (20, "units"), (91, "distance"), (93, "feed_mode"),
     (55, "system")],
)  # fmt: skip
def test_every_group_has_its_place(code, name):
    assert getattr(Modal().with_g(float(code)), name) == code


def test_other_codes_change_nothing():
    assert Modal().with_g(28.0) == Modal().with_m(0) == Modal()


def test_coolants_are_two_and_m9_ends_both():
    both = Modal().with_m(7).with_m(8)
    assert both.mist
    assert both.flood
    assert both.with_m(9).quiet


def test_m30_keeps_units_feed_and_speed():
    state = Modal(units=20, distance=91, feed=5, speed=9, spindle=3).with_m(30)
    assert state == Modal(motion=1, units=20, feed=5, speed=9)
