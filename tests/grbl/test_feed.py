import pytest

from relieffab.grbl.feed import Feed, alone
from relieffab.grbl.program import Line, prepare

PROGRAM = prepare("G0X0Y0Z5\nG1X3F60\nG1X7\nG92X0\nG1X9")


def test_lines_come_with_their_way():
    feed = Feed(PROGRAM, (1.0, 0.0, 5.0))
    line, motion = feed.take()
    assert (line.number, motion.length) == (1, 1.0)
    assert feed.next.number == 2


def test_what_lies_before_the_first_line_is_followed_and_counted():
    feed = Feed(PROGRAM, (3.0, 0.0, 5.0), 2)
    assert feed.cut_mm == 3
    line, motion = feed.take()
    assert (line.number, motion.length, motion.feed) == (3, 4, 60)


def test_what_cannot_be_followed_is_admitted():
    feed = Feed(PROGRAM, (0.0, 0.0, 0.0))
    followed = []
    while feed.next is not None:
        feed.take()
        followed.append(feed.followed)
    assert followed == [True, True, True, False, False]
    with pytest.raises(IndexError):
        feed.take()


def test_eeprom_writers_go_alone():
    assert alone(Line(0, 1, b"$110=5\n"))
    assert not alone(Line(0, 1, b"G1X1\n"))
