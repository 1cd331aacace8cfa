"""Strokes turned into lines."""

import numpy as np

from relieffab.layers.model import Stroke
from relieffab.toolpath.engrave import stroke_lines


def stroke(points, closed=False):
    points = np.asarray(points, float)
    return Stroke(points, "crease", np.ones(len(points)), closed)


def test_closed_strokes_end_where_they_start():
    (line,) = stroke_lines([stroke([[0, 0], [2, 0], [1, 2]], closed=True)])
    assert np.array_equal(line[0], line[-1])
    assert len(line) == 4


def test_curves_keep_their_shape():
    t = np.linspace(0, 3, 300)
    (line,) = stroke_lines([stroke(np.column_stack([np.cos(t), np.sin(t)]))])
    middle = 0.5 * (line[1:] + line[:-1])
    assert 1 - np.hypot(*middle.T).min() < 0.011


def test_strokes_of_one_place_are_left_out():
    assert stroke_lines([stroke([[1, 1], [1, 1]]), stroke([[1, 1]])]) == []


def test_highlights_are_not_cut():
    points = np.array([[0.0, 0.0], [2.0, 0.0]])
    light = Stroke(points, "suggestive-highlight", np.ones(2))
    assert light.light
    assert len(stroke_lines([light, stroke(points)])) == 1
