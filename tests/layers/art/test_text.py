import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.art.text import LINE, set_text


def lefts(art):
    return [min(ring.points[:, 0].min() for ring in mark.rings) for mark in art.marks]


def test_glyphs_stand_side_by_side_with_their_holes(font):
    art = set_text("OO D", font)
    assert [len(mark.rings) for mark in art.marks] == [2, 2, 1]
    np.testing.assert_allclose(np.diff(lefts(art)), [600, 1100], atol=1)
    x0, y0, _, y1 = art.bounds
    assert (x0, y0, y1) == pytest.approx((-1100, -700, 0))
    assert art.page is None
    assert {mark.fill for mark in art.marks} == {"nonzero"}


def test_lines_are_centred_and_parted_either_way(font):
    for text in ("OOO\nO", r"OOO\nO"):
        first, *_, last = set_text(text, font).marks
        middle = last.rings[0].points[:, 0].mean()
        assert middle == pytest.approx(0.0)
        down = last.rings[0].points[:, 1].max() - first.rings[0].points[:, 1].max()
        assert down == pytest.approx(LINE * 1000)


def test_pairs_are_kerned(font, kerned):
    assert np.diff(lefts(set_text("OD", kerned))) == np.diff(lefts(set_text("OD", font))) - 150


def test_hieroglyphs_are_characters_like_others(font):
    assert len(set_text("\U00013000", font).marks) == 1


def test_a_missing_glyph_is_named(font):
    with pytest.raises(InputError, match=r"(?s)lacks glyphs.*'X' \(U\+0058 LATIN CAPITAL"):
        set_text("OX", font)


@pytest.mark.parametrize("text", ["", "  ", "\\n"])
def test_blank_text_is_refused(font, text):
    with pytest.raises(InputError, match="no text"):
        set_text(text, font)


@pytest.mark.parametrize("text", ["\u0633\u0644", "\u05d0", "O\u0336"])
def test_scripts_that_take_a_shaper_are_refused(font, text):
    with pytest.raises(InputError, match="joins, stacks or reorders"):
        set_text(text, font)


def test_a_broken_font_is_refused(tmp_path, font):
    for name, data in (("a.ttf", b"\0\1\0\0" + bytes(60)), ("b.ttf", font.read_bytes()[:300])):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(InputError, match="font cannot be read"):
            set_text("O", tmp_path / name)
