from math import inf

import numpy as np
import pytest

from relieffab.relief.style.chisels import Chisel
from relieffab.relief.style.strokes import BLOW, EVEN, SHORTEST, depths, parts, strokes

HAND = Chisel("ball-2", 1.0, 0.2, length=5.0, entry=2.0, leave=1.0, gap=0.5)


def test_a_line_is_parted_into_strokes_with_gaps():
    found = parts(100.0, HAND, np.random.default_rng(0))
    starts, ends = np.array(found).T
    assert starts[0] == 0 and ends[-1] == 100.0
    np.testing.assert_allclose(starts[1:] - ends[:-1], HAND.gap)
    lengths = (ends - starts)[1:-1]
    assert lengths.min() >= HAND.length * (1 - EVEN)
    assert lengths.max() <= HAND.length * (1 + EVEN) + SHORTEST + HAND.gap
    assert lengths.mean() == pytest.approx(HAND.length, rel=0.1)


def test_no_stroke_is_too_short_and_an_endless_one_is_whole():
    for length in np.linspace(0.1, 12, 40):
        found = parts(length, HAND, np.random.default_rng(1))
        assert all(b - a >= SHORTEST and 0 <= a < b <= length for a, b in found)
    endless = Chisel("ball-2", 1.0, 0.2, length=inf)
    assert parts(3.0, endless, np.random.default_rng(0)) == [(0.0, 3.0)]


def test_a_stroke_enters_is_deep_and_leaves():
    along = np.linspace(4.0, 10.0, 601)
    deep = depths(along, HAND)
    assert deep[0] == deep[-1] == 0
    np.testing.assert_allclose(deep[(along >= 6.0) & (along <= 9.0)], 0.2)
    assert deep[100] == pytest.approx(0.1)  # half way in
    assert deep[550] == pytest.approx(0.1)  # half way out
    short = depths(np.linspace(0, 1.5, 301), HAND)
    assert short.max() == pytest.approx(0.2) and short.argmax() == 200


def test_blows_come_at_even_distances():
    chisel = Chisel("ball-2", 1.0, 0.2, entry=0.0, leave=0.0, chatter=0.5)
    along = np.linspace(0, 3 * BLOW, 301)
    deep = depths(along, chisel)
    np.testing.assert_allclose(deep[[100, 200]], 0.2)
    np.testing.assert_allclose(deep[[50, 150, 250]], 0.1)


def test_strokes_lie_on_their_lines():
    line = np.column_stack([np.linspace(0, 60, 13), np.full(13, 7.0)])
    found = strokes([line], HAND, 6.0, np.random.default_rng(2))
    assert len(found) >= 2
    for places, deep in found:
        assert (places[:, 1] == 7.0).all() and len(places) == len(deep)
        assert np.diff(places[:, 0]).max() <= 1.0 and (np.diff(places[:, 0]) > 0).all()
        assert 0.15 < deep.max() <= 0.2
