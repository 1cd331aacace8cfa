import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.art.art import Mark, Ring
from relieffab.layers.art.clip import clipped, joined
from relieffab.layers.art.fill import inside

GRID = Grid.on_panel((20.0, 20.0), (40, 40))
SQUARE = np.array([[4.0, 4.0], [16.0, 4.0], [16.0, 16.0], [4.0, 16.0]])
STAR = 10 + 9 * np.array([[np.sin(4 * np.pi * k / 5), np.cos(4 * np.pi * k / 5)] for k in range(5)])


def area(points, rule="nonzero"):
    return Mark((Ring(points, True),), fill=rule)


def pixels(mark):
    return inside([ring.points for ring in mark.rings], mark.fill, GRID)


@pytest.mark.parametrize("rule", ["nonzero", "evenodd"])
@pytest.mark.parametrize("clip", ["nonzero", "evenodd"])
def test_areas_are_what_both_fill(rule, clip):
    mark, region = area(STAR + 1.3, rule), [area(STAR, clip), area(SQUARE * 0.4)]
    (left,) = clipped(mark, region)
    want = pixels(mark) & (pixels(region[0]) | pixels(region[1]))
    np.testing.assert_array_equal(pixels(left), want)


def test_lines_end_where_the_region_does():
    line = Mark((Ring(np.array([[0.0, 10.0], [20.0, 10.0], [20.0, 0.0]]), False),), width=0.5)
    (left,) = clipped(line, [area(SQUARE)])
    assert left.width == 0.5
    ends = np.sort(left.rings[0].points[:, 0])
    np.testing.assert_allclose(ends, [4, 16], atol=1e-6)


def test_nothing_is_left_of_what_lies_beyond_or_within_nothing():
    far = area(SQUARE + 100)
    dot = Mark((Ring(np.array([[4.0, 4.0], [8.0, 8.0]]), True),), fill="nonzero")
    assert clipped(area(SQUARE), [far]) == []
    assert clipped(area(SQUARE), []) == []
    assert clipped(area(SQUARE), [dot]) == []
    assert clipped(dot, [area(SQUARE)]) == []


def test_areas_that_overlap_become_one_without_a_line_through_it():
    hole = Ring(SQUARE[::-1] * 0.5 + 5.0, True)
    framed = Mark((Ring(SQUARE, True), hole), fill="nonzero")
    apart, over = area(SQUARE + np.array([30.0, 0.0])), area(SQUARE + np.array([11.0, 2.0]))
    assert joined([framed, apart]) == [framed, apart]
    (both,) = joined([framed, over])
    assert len(both.rings) == 2
    np.testing.assert_array_equal(pixels(both), pixels(framed) | pixels(over))
