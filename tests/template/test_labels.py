import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.template.contours import depth_contours
from relieffab.template.labels import AGAIN, CLEAR, depth_labels
from relieffab.template.marks import PAPER, Line, Text

COLOURS = [f"#{k:06x}" for k in range(1, 31)]


def labelled(relief, strokes=(), step=0.6):
    marks = depth_labels(depth_contours(relief, step), relief, strokes, COLOURS)
    return [mark for mark in marks if isinstance(mark, Text)]


def test_every_long_contour_of_a_gentle_cone_says_its_depth(bowl):
    labels = labelled(bowl)
    assert {label.words: label.colour for label in labels} == {
        "0.6": "#000001", "1.2": "#000002", "1.8": "#000003", "2.4": "#000004",
    }  # fmt: skip
    for label in labels:
        away = np.hypot(label.x - 30, label.y - 20)
        assert away == pytest.approx(15 * (1 - float(label.words) / 3), abs=1.0)
        assert -90 <= label.angle <= 90


def test_a_long_contour_says_its_depth_again_but_not_at_once():
    x = np.arange(601) * 0.5
    heights = np.tile(-2.0 * np.clip(1 - np.abs(np.arange(101) - 50) / 40, 0, 1), (601, 1)).T
    heights = heights * np.clip(np.minimum(x, x[-1] - x) / 20, 0, 1)
    grid = Grid(100, 600, 0.5, (0.0, 50.0))
    ditch = Relief(grid, heights, np.ones(grid.shape, bool), 2.0)
    places = [(label.x, label.y) for label in labelled(ditch, step=1.0)]
    assert len(places) > 6
    for k, one in enumerate(places):
        assert all(np.hypot(*np.subtract(one, other)) > AGAIN - 2 for other in places[:k])


def test_the_line_is_open_under_its_label(bowl):
    marks = depth_labels(depth_contours(bowl, 0.6), bowl, (), COLOURS)
    gaps = [mark for mark in marks if isinstance(mark, Line)]
    assert len(gaps) == len(marks) / 2
    assert {gap.colour for gap in gaps} == {PAPER}


def test_labels_keep_clear_of_drawn_lines(bowl, strokes):
    for label in labelled(bowl, strokes):
        assert abs(label.y - 20) > CLEAR - 1 or not 20 < label.x < 40


def test_where_contours_run_close_there_are_none(bowl):
    # A slope of 0.2 gives 0.5 mm from one contour to the next.
    assert labelled(bowl, step=0.1) == []
