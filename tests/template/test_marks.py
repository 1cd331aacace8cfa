import numpy as np
import pytest

from relieffab.template.marks import (
    Line,
    Text,
    cross,
    moved,
    plain,
    polyline,
    rectangle,
    scale_bar,
)


def test_the_scale_is_100_mm_with_a_tick_every_ten():
    marks = scale_bar(7.0, 5.0)
    lines = [mark for mark in marks if isinstance(mark, Line)]
    assert np.ptp(lines[0].points[:, 0]) == 100.0
    ticks = [line.points[0, 0] - 7 for line in lines[1:]]
    assert ticks == [10.0 * k for k in range(11)]
    words = {mark.words: mark.x - 7 for mark in marks if isinstance(mark, Text)}
    assert words == {"0": 0.0, "50": 50.0, "100 mm": 100.0}


def test_moving_moves_lines_and_words_and_leaves_the_old_ones():
    old = [polyline([(0, 0), (1, 2)], "#123456", 0.4), Text(3.0, 4.0, "a", angle=30.0)]
    line, text = moved(old, 10.0, -1.0)
    np.testing.assert_array_equal(line.points, [[10, -1], [11, 1]])
    assert (line.colour, line.width) == ("#123456", 0.4)
    assert (text.x, text.y, text.angle) == (13.0, 3.0, 30.0)
    assert old[1].x == 3.0


def test_crosses_and_rectangles_are_where_they_should():
    points = np.concatenate([line.points for line in cross(5.0, 6.0, 3.0)])
    assert points.mean(axis=0) == pytest.approx([5, 6])
    box = rectangle(1.0, 2.0, 3.0, 5.0)
    assert box.closed
    assert (box.points.min(axis=0).tolist(), box.points.max(axis=0).tolist()) == ([1, 2], [3, 5])


def test_words_from_file_names_are_made_printable():
    assert plain("a\x01b\udcff.ply") == "a?b?.ply"
    assert len(plain("x" * 300)) == 48
