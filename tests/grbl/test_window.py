import pytest

from relieffab.grbl.program import prepare
from relieffab.grbl.window import Window


@pytest.fixture
def window():
    window = Window(20)
    for line in prepare("G1X10\nG1X11\nG1X12").read():
        window.sent(line)
    return window


def test_bytes_are_counted_until_acknowledged(window):
    assert (window.bytes, len(window)) == (18, 3)
    assert window.fits(2)
    assert not window.fits(3)
    assert window.acknowledged().number == 1
    assert (window.bytes, window.total, window.first.number) == (12, 18, 2)


def test_an_acknowledgement_too_many_names_nothing(window):
    for _ in range(3):
        window.acknowledged()
    assert window.acknowledged() is None
    assert (window.bytes, window.first) == (0, None)


@pytest.mark.parametrize(
    ("sent", "used", "missing"),
    [
        (18, 18, -6),  # nothing read yet
        (18, 12, 0),  # the first line is being worked on
        (18, 6, 6),  # two lines are read and one acknowledgement is overdue
        (18, 11, 1),  # one byte vanished
        (6, 0, 0),  # the rest was sent after the question
    ],
)
def test_what_the_controller_must_still_hold(window, sent, used, missing):
    assert window.missing(sent, used) == missing


@pytest.mark.parametrize(("used", "excess"), [(18, 0), (19, 1), (0, -18)])
def test_what_the_controller_may_hold_at_most(window, used, excess):
    assert window.excess(used) == excess
    assert window.excess(used, waiting=True) == excess + 6


def test_nothing_is_held_that_is_acknowledged(window):
    for _ in range(3):
        window.acknowledged()
    assert window.excess(6) == 6
