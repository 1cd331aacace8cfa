import pytest

from relieffab import units
from relieffab.errors import InputError


@pytest.mark.parametrize(
    ("text", "mm"),
    [
        ("6mm", 6), ("6", 6), (6, 6), ("0.25in", 6.35), ('0.25"', 6.35), ("1.2 cm", 12),
        ("500um", 0.5), (".5mm", 0.5), ("1e1mm", 10), ("-3mm", -3), ("0.1m", 100),
    ],
)  # fmt: skip
def test_lengths_in_any_unit_are_millimetres(text, mm):
    assert units.length(text) == pytest.approx(mm)


@pytest.mark.parametrize(
    "text", ["", "mm", "6 parsec", "1/8in", "six", "6mm2", "nan", "inf", "6,5mm"]
)
def test_what_is_no_length_is_refused(text):
    with pytest.raises(InputError):
        units.length(text)


def test_sizes_share_the_last_unit():
    assert units.lengths("120x90mm") == (120, 90)
    assert units.lengths("4in x 30mm") == pytest.approx((101.6, 30))
    assert units.lengths("4x3in") == pytest.approx((101.6, 76.2))


def test_feeds_and_angles():
    assert units.feed("10mm/s") == 600
    assert units.feed("30in/min") == pytest.approx(762)
    assert units.feed(800) == 800
    assert units.angle("0.5rad") == pytest.approx(28.6478898)
    with pytest.raises(InputError, match="time"):
        units.feed("10mm/fortnight")
