import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.model import Layers, Stroke
from relieffab.relief.groove import inked, swept
from relieffab.relief.reach import ball


def drawn(layers, points, strength, *, closed=False, kind="contour"):
    stroke = Stroke(np.asarray(points, float), kind, np.asarray(strength, float), closed)
    return Layers(**{**vars(layers), "strokes": (stroke,)})


def vee(r):
    return np.asarray(r, float)


def distance(layers, a, b):
    x, y = np.meshgrid(*layers.grid.node_axes())
    point, way = np.stack([x, y], axis=2) - a, np.subtract(b, a)
    share = np.clip(point @ way / (way @ way), 0, 1)
    return np.linalg.norm(point - share[..., None] * way, axis=2), share


def test_a_groove_has_the_tips_own_shape(layers):
    a, b = np.array([18.0, 14.0]), np.array([21.5, 16.3])
    for profile in (vee, ball(0.8)):
        cut = swept(drawn(layers, [a, b], [1, 1]), 0.5, profile)
        away, _ = distance(layers, a, b)
        np.testing.assert_allclose(cut, np.minimum(profile(away) - 0.5, 0.0), atol=2e-3)


def test_principal_lines_are_deeper(layers):
    a, b = np.array([18.0, 14.0]), np.array([21.5, 16.3])
    cut = swept(drawn(layers, [a, b], [0, 1]), 0.5, vee)
    away, share = distance(layers, a, b)
    deep = 0.25 + 0.25 * share
    np.testing.assert_allclose(cut, np.minimum(away - deep, 0.0), atol=2e-3)


def test_a_loop_is_closed_and_highlights_are_not_cut(layers):
    corners = [(16.0, 11.0), (24.0, 11.0), (20.0, 19.0)]
    closing, share = distance(layers, np.array(corners[2]), np.array(corners[0]))
    there = (closing < 0.1) & (share > 0.3) & (share < 0.7)
    assert there.any()
    assert (swept(drawn(layers, corners, [1, 1, 1], closed=True), 0.3, vee)[there] < -0.15).all()
    opened = swept(drawn(layers, corners, [1, 1, 1]), 0.3, vee)
    assert (opened[there] == 0).all(), opened[there]
    light = drawn(layers, corners, [1, 1, 1], kind="suggestive-highlight")
    assert (swept(light, 0.3, vee) == 0).all()


def test_ink_without_strokes_cannot_be_followed(layers):
    lines = np.zeros(layers.grid.shape)
    lines[10:20, 30] = 1.0
    inked_only = Layers(**{**vars(layers), "lines": lines, "strokes": ()})
    with pytest.raises(InputError, match="only a picture"):
        swept(inked_only, 0.5, vee)
    assert (swept(inked_only, 0.0, vee) == 0).all()


def test_ink_of_full_strength_reaches_the_line_depth(layers):
    lines = np.zeros(layers.grid.shape)
    lines[:, 70:90] = 1.0
    cut = inked(Layers(**{**vars(layers), "lines": lines}), 0.4)
    assert cut.min() == pytest.approx(-0.4)
    assert (cut[:, :60] == 0).all()
