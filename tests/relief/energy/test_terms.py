from dataclasses import replace

import numpy as np
import pytest

from relieffab.relief.energy.rows import DEPTH, EXACT, FORM, HALF, LIGHT, LINE, ONE, TWIST
from relieffab.relief.energy.terms import ROWS, asked, columns, spans


def test_columns_are_the_widest_row_and_two_to_spare():
    figure = np.zeros((12, 20), bool)
    figure[3, 6:9] = True
    figure[4, 8:14] = True
    figure[9, 4] = True
    places = columns(figure, np.array([-2, 3, 5, 8]), 4)
    np.testing.assert_array_equal(places, [(0, 0), (4, 16), (0, 0), (2, 7)])


def test_a_block_that_starts_above_the_lattice_is_cut_short():
    figure = np.zeros((12, 20), bool)
    figure[2, 5] = figure[4, 9] = True
    np.testing.assert_array_equal(columns(figure, np.array([-2]), 5), [(3, 8)])


@pytest.mark.parametrize("rows", [24, ROWS + 4, ROWS + 5, 3 * ROWS])
def test_spans_cover_the_figure(make_terms, rows):
    figure = make_terms((rows, 30)).figure.copy()
    figure[:, 3 : 3 + rows // 5] = False
    seen = np.zeros_like(figure)
    places = spans(figure)
    for block, (low, high) in enumerate(places):
        top = 2 + block * ROWS
        seen[top : min(top + ROWS, rows - 2), low + 2 : high - 2] = True
        near = figure[max(top - 2, 0) : top + ROWS + 2].any(axis=0)
        assert near[low + 2]
        assert near[high - 3]
    assert seen[figure].all()
    assert len(places) == -(-(rows - 4) // ROWS)


def test_an_empty_block_has_no_columns(make_terms):
    figure = make_terms((3 * ROWS, 30)).figure.copy()
    figure[ROWS:] = False
    low, high = spans(figure)[2]
    assert low == high


def test_constants_are_weights_times_what_diagonals_and_pitch_make_of_them(terms):
    c, w, half = terms.constants(np.float64), terms.weights, 0.5 / terms.pitch
    assert len(c) == 8
    assert c[HALF] == pytest.approx(half)
    assert c[DEPTH] == pytest.approx(2 * w.depth * half**2)
    assert c[LINE] == pytest.approx(2 * w.line * half**2)
    assert c[TWIST] == pytest.approx(w.twist * half**2)
    assert c[LIGHT] == pytest.approx(2 * w.light * half**2)
    assert c[FORM] == w.form
    assert c[EXACT] == c[ONE] == 1
    assert replace(terms, lagged=True).constants(np.float64)[EXACT] == 0
    assert terms.constants(np.float32).dtype == np.float32


def test_asked_is_what_weighs(terms):
    picked = asked(terms)
    assert picked.mask is terms.mask
    assert picked.stencil is terms.stencil
    assert picked.whole is terms.whole
