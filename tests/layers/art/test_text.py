import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.art.text import LINE, set_text


def lefts(art):
    return [min(ring.points[:, 0].min() for ring in mark.rings) for mark in art.marks]


def width(art):
    x0, _, x1, _ = art.bounds
    return x1 - x0


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
    assert width(set_text("OD", kerned)) == pytest.approx(width(set_text("OD", font)) - 150)


def test_glyphs_that_overlap_are_one_area(build_font):
    tight = build_font("feature kern { pos O O -300; } kern;")
    (both,) = set_text("OO", tight).marks
    x = both.rings[0].points[:, 0]
    assert np.ptp(x) == pytest.approx(700.0)
    assert len(both.rings) == 3  # the outline and two holes


def test_hieroglyphs_are_characters_like_others(font):
    assert len(set_text("\U00013000", font).marks) == 1


def test_a_missing_glyph_is_named(font):
    with pytest.raises(InputError, match=r"(?s)lacks glyphs.*'X' \(U\+0058 LATIN CAPITAL"):
        set_text("OX", font)


@pytest.mark.parametrize("text", ["", "  ", "\\n"])
def test_blank_text_is_refused(font, text):
    with pytest.raises(InputError, match="no text"):
        set_text(text, font)


def heights(art):
    return [mark.rings[0].points[:, 1].min() for mark in art.marks]


def test_glyphs_are_kerned_as_newer_fonts_say(build_font, font):
    kern = build_font("feature kern { pos O D -80; } kern;")
    assert width(set_text("OD", kern)) == pytest.approx(width(set_text("OD", font)) - 80)


def test_letters_join_into_one_glyph(build_font):
    joined = build_font("feature liga { sub O D by tall; } liga;")
    assert heights(set_text("ODO", joined)) == [-1400, -700]


def test_hieroglyphs_are_stacked_by_format_controls(build_font):
    sign, joiner = "\U00013000", "\U00013430"
    stack = "languagesystem egyp dflt; feature rlig { sub O mark O by tall; } rlig;"
    font = build_font(stack, **{joiner: "mark"})
    assert heights(set_text(sign + joiner + sign + sign, font)) == [-1400, -700]
    # Latin before it is a run of its own, so that the hieroglyphs keep their script's rules.
    assert heights(set_text("O " + sign + joiner + sign, font)) == [-700, -1400]


def test_marks_stand_where_their_letter_has_them(build_font):
    placed = """
        markClass mark <anchor 50 0> @TOP;
        feature mark { pos base O <anchor 300 700> mark @TOP; } mark;
        table GDEF { GlyphClassDef [O D], , [mark], ; } GDEF;
    """
    art = set_text("O\u0336O", build_font(placed, **{"\u0336": "mark"}))
    first, mark, _ = art.marks
    np.testing.assert_allclose(
        mark.rings[0].points.mean(axis=0) - first.rings[0].points.mean(axis=0), [0, -400]
    )


ARABIC = """
    languagesystem arab dflt;
    feature init { sub O by tall; } init;
    feature fina { sub O by mark; } fina;
"""


def test_arabic_joins_and_reads_from_right_to_left(build_font):
    beh = "\u0628"
    font = build_font(ARABIC, **{beh: "O", "1": "D", "2": "tall"})
    last, first = set_text(beh * 2, font).marks
    assert last.rings[0].points[:, 1].min() == -100
    assert first.rings[0].points[:, 1].min() == -1400
    assert last.rings[0].points[:, 0].max() < first.rings[0].points[:, 0].min()


def test_numbers_read_from_left_to_right_in_any_script(build_font):
    alef = "\u05d0"
    font = build_font("", **{alef: "O", "1": "D", "2": "tall"})
    number, letter = heights(set_text(f"{alef} 12", font)), heights(set_text(alef, font))
    assert number == [*heights(set_text("12", font)), *letter]


def test_a_line_that_reads_both_ways_is_refused(build_font):
    font = build_font("", **{"\u05d0": "O"})
    with pytest.raises(InputError, match=r"(?s)both.*'O' \(LATIN CAPITAL LETTER O\) and '\u05d0'"):
        set_text("O \u05d0", font)
    assert len(set_text("O\n\u05d0", font).marks) == 2


def test_what_has_no_glyph_is_named_wherever_it_stands(build_font):
    font = build_font(ARABIC, **{"\u0628": "O"})
    with pytest.raises(InputError, match=r"U\+0336 COMBINING") as fault:
        set_text("\u0628\u0628\u0336", font)
    assert "U+0628" not in fault.value.parts["found"]


def test_the_wrapping_of_the_web_is_taken_off(tmp_path, font):
    from fontTools.ttLib import TTFont

    with TTFont(font) as wrapped:
        wrapped.flavor = "woff"
        wrapped.save(tmp_path / "a.woff")
    assert set_text("OD", tmp_path / "a.woff").bounds == set_text("OD", font).bounds


def test_a_broken_font_is_refused(tmp_path, font):
    for name, data in (("a.ttf", b"\0\1\0\0" + bytes(60)), ("b.ttf", font.read_bytes()[:300])):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(InputError, match="font cannot be read"):
            set_text("O", tmp_path / name)
