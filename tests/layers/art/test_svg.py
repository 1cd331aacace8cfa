import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.art.svg import read_svg

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '


def svg(path, body, size='width="100mm" height="80mm" viewBox="0 0 200 160"', before=""):
    path = path / "a.svg"
    path.write_text(f"{before}{HEAD}{size}>{body}</svg>")
    return path


def marks(path, body, **more):
    return read_svg(svg(path, body, **more)).marks


def test_units_viewbox_transforms_and_stroke_width(tmp_path):
    art = read_svg(
        svg(tmp_path, '<g transform="translate(50,50) rotate(90)">'
            '<rect width="40" height="20" fill="none" stroke="#000" stroke-width="2"/></g>')
    )  # fmt: skip
    assert art.page == pytest.approx((100, 80), rel=1e-5)
    (mark,) = art.marks
    assert (mark.fill, mark.width) == (None, pytest.approx(1.0, rel=1e-5))
    corners = mark.rings[0].points
    np.testing.assert_allclose(corners[:3], [[25, 25], [25, 45], [15, 45]], atol=1e-3)
    assert mark.rings[0].closed


def test_curves_arcs_styles_and_use(tmp_path):
    found = marks(
        tmp_path,
        "<style>.thin{fill:none;stroke:black;stroke-width:1}</style>"
        '<defs><circle id="c" r="10"/></defs><use xlink:href="#c" x="60" y="60"/>'
        '<path class="thin" d="M100 100 a 20 20 0 0 1 40 0 q 10 -20 20 0"/>',
    )
    disc, line = found
    assert (disc.fill, disc.width, line.fill) == ("nonzero", None, None)
    np.testing.assert_allclose(np.hypot(*(disc.rings[0].points - [30, 30]).T), 5, atol=0.01)
    arc = line.rings[0].points
    assert not line.rings[0].closed
    upper = arc[arc[:, 0] < 69.9]
    np.testing.assert_allclose(np.hypot(*(upper - [60, 50]).T), 10, atol=0.01)


def test_fills_white_on_top_holes_and_what_is_hidden(tmp_path):
    found = marks(
        tmp_path,
        '<rect width="9" height="9"/><rect width="5" height="5" fill="#fff"/>'
        '<path d="M0 0h9v9h-9z M2 2h3v3h-3z" fill-rule="evenodd"/>'
        '<rect width="9" height="9" fill="none"/><rect width="9" height="9" display="none"/>'
        '<rect width="9" height="9" fill="none" stroke="white"/>',
    )
    assert [(mark.fill, mark.paper) for mark in found] == [
        ("nonzero", False),
        ("nonzero", True),
        ("evenodd", False),
    ]


def test_without_units_it_has_no_size_of_its_own(tmp_path):
    for size in ("", 'viewBox="0 0 10 10"', 'width="100%" height="100%" viewBox="0 0 10 10"'):
        assert read_svg(svg(tmp_path, '<rect width="9" height="9"/>', size=size)).page is None


def test_scripts_texts_and_pictures_are_left_out_and_named(tmp_path):
    art = read_svg(
        svg(tmp_path, '<script>alert(1)</script><text x="1" y="9">hi</text>'
            '<rect width="9" height="9"/>')
    )  # fmt: skip
    assert len(art.marks) == 1
    assert [note.split()[1] for note in art.notes] == ["scripts", "texts"]


CLIPS = (
    '<defs><clipPath id="c"><rect x="20" y="20" width="40" height="40"/></clipPath>'
    '<clipPath id="b" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath>'
    '<mask id="m"><rect width="9" height="9" fill="white"/></mask></defs>'
)


def extent(found):
    points = np.concatenate([ring.points for mark in found for ring in mark.rings])
    return [*points.min(axis=0), *points.max(axis=0)]


@pytest.mark.parametrize(
    ("body", "left"),
    [
        ('<rect width="200" height="30" clip-path="url(#c)"/>', [10, 10, 30, 15]),
        ('<rect width="200" height="30" style="clip-path:url(#c)"/>', [10, 10, 30, 15]),
        ('<g clip-path="url(#c)"><rect width="30" height="30"/><g/></g>', [10, 10, 15, 15]),
        ('<g transform="scale(2)" clip-path="url(#c)"><rect width="99" height="99"/></g>',
         [20, 20, 60, 60]),
        ('<g clip-path="url(#c)"><path clip-path="url(#c)" transform="translate(20)" '
         'd="M0 0h99v99h-99z"/></g>', [20, 10, 30, 30]),
        ('<g id="g" clip-path="url(#c)"><rect width="99" height="99"/></g>'
         '<use href="#g" x="100"/>', [10, 10, 80, 30]),
    ],
)  # fmt: skip
def test_clips_are_applied_in_the_coordinates_of_what_they_clip(tmp_path, body, left):
    art = read_svg(svg(tmp_path, CLIPS + body))
    assert art.notes == ()
    np.testing.assert_allclose(extent(art.marks), left, atol=1e-3)


def test_a_stroke_is_clipped_by_itself(tmp_path):
    art = read_svg(
        svg(tmp_path, CLIPS + '<rect x="30" y="10" width="60" height="20" stroke="#000" '
            'stroke-width="2" clip-path="url(#c)"/>')
    )  # fmt: skip
    area, line = art.marks
    assert (area.fill, area.width, line.fill) == ("nonzero", None, None)
    assert not any(ring.closed for ring in line.rings)
    np.testing.assert_allclose(extent([line]), [15, 10, 30, 15], atol=1e-3)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ('<rect id="r" width="9" height="9" clip-path="url(#b)"/>', "<rect> 'r': its clip is not"),
        ('<rect width="9" height="9" clip-path="url(#lost)"/>', "<rect> in line 1: its clip is"),
        ('<rect width="9" height="9" mask="url(#m)"/>', "<rect> in line 1: its mask is"),
        ('<style>.a{clip-path:url(#c)}</style><rect class="a" width="9" height="9"/>',
         "1 clips or masks of a style sheet are not applied"),
        ('<linearGradient id="l"/><rect width="9" height="9" fill="url(#l)"/>', "1 gradients"),
        ('<path d="M0 0h9" stroke="#000" stroke-dasharray="2 1"/>', "1 dashed lines drawn whole"),
        ('<path d="M0 0h9" stroke="#000" marker-end="url(#m)"/>', "1 lines without their markers"),
        ('<rect width="9" height="9" filter="url(#f)"/>', "1 filters are not applied"),
        ('<rect width="9" height="9"/><use href="other.svg#a"/>', "<use> in line 1 shows what is"),
        ('<svg width="3cm" height="3cm"><rect width="9" height="9"/></svg>', "<svg> in line 1:"),
    ],
)  # fmt: skip
def test_what_is_not_drawn_as_it_is_painted_is_told(tmp_path, body, said):
    art = read_svg(svg(tmp_path, CLIPS + body))
    (note,) = art.notes
    assert note.startswith(said)
    assert len(art.marks) == 1


@pytest.mark.parametrize(
    "hidden",
    [
        'visibility="hidden"', 'style="visibility:hidden"', 'style="display:none"', 'opacity="0"',
        'class="h"', 'fill-opacity="0"',
    ],
)  # fmt: skip
def test_what_is_hidden_is_not_carved(tmp_path, hidden):
    sheet = "<style>.h{visibility:hidden}</style>"
    hidden = f'<rect width="9" height="9" {hidden}/>'
    assert len(marks(tmp_path, f'{sheet}{hidden}<rect width="9" height="9"/>')) == 1
    group = '<g visibility="hidden"><rect width="9" height="9"/></g>'
    assert len(marks(tmp_path, f'{group}<rect width="9" height="9"/>')) == 1


@pytest.mark.parametrize(
    ("body", "left"),
    [
        ('<symbol id="s" viewBox="0 0 10 10"><rect width="10" height="10"/></symbol>'
         '<use href="#s" x="20" width="40" height="20"/>', [15, 0, 25, 10]),
        ('<symbol id="s" viewBox="0 0 10 10" preserveAspectRatio="none"><rect width="10" '
         'height="10"/></symbol><use href="#s" x="20" width="40" height="20" '
         'transform="translate(0,10)"/>',
         [10, 5, 30, 15]),
        ('<svg x="20" y="40" width="60" height="20" viewBox="10 10 3 2" '
         'preserveAspectRatio="xMinYMid meet"><path d="M10 10h9v2h-9z"/></svg>', [10, 20, 40, 30]),
        ('<svg x="20" y="40" width="20" height="20" overflow="visible"><rect width="99" '
         'height="9"/></svg>', [10, 20, 59.5, 24.5]),
    ],
)  # fmt: skip
def test_symbols_and_pages_within_the_page_have_their_place(tmp_path, body, left):
    np.testing.assert_allclose(extent(marks(tmp_path, body)), left, atol=0.04)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("", "no path"),
        ('<symbol><rect width="9" height="9"/></symbol>', "no path"),
        (CLIPS + '<rect x="99" width="9" height="9" clip-path="url(#c)"/>', "no path"),
        ('<image href="a.png" width="9" height="9"/>', "1 pictures left out"),
        ("<text>hello</text>", "1 texts left out"),
        ('<path d="" fill="none" stroke="black"/>', "no path"),
        ('<path d="M0 0L1e999 3" stroke="black"/>', "not numbers"),
    ],
)
def test_nothing_to_carve_is_an_error(tmp_path, body, said):
    with pytest.raises(InputError, match=said):
        read_svg(svg(tmp_path, body))


@pytest.mark.parametrize("word", ["inherit", "calc(1)", "50%", "1e-3"])
def test_opacities_in_any_words_are_read(tmp_path, word):
    art = read_svg(svg(tmp_path, f'<rect width="9" height="9" opacity="{word}"/>'))
    assert len(art.marks) == 1


def test_what_shows_itself_is_an_error(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_svg(svg(tmp_path, '<g id="g"><use href="#g"/><rect width="9" height="9"/></g>'))


def test_nothing_is_fetched_and_nothing_blown_up(tmp_path):
    (tmp_path / "secret").write_text("9")
    outside = '<!DOCTYPE svg [<!ENTITY x SYSTEM "secret">]>'
    with pytest.raises(InputError, match="external entities"):
        read_svg(svg(tmp_path, '<rect width="&x;" height="9"/>', before=outside))
    bomb = "".join(f'<!ENTITY a{k} "{f"&a{k - 1};" * 50}">' for k in range(1, 8))
    with pytest.raises(InputError, match="cannot be read"):
        read_svg(svg(tmp_path, "<desc>&a7;</desc>",
                     before=f'<!DOCTYPE svg [<!ENTITY a0 "{"x" * 50}">{bomb}]>'))  # fmt: skip
    inside = '<!DOCTYPE svg [<!ENTITY w "9">]>'
    assert len(marks(tmp_path, '<rect width="&w;" height="9"/>', before=inside)) == 1


@pytest.mark.parametrize("text", ["", "<svg", "<html/>", "plain"])
def test_what_is_no_svg(tmp_path, text):
    (tmp_path / "a.svg").write_text(text)
    with pytest.raises(InputError, match="SVG"):
        read_svg(tmp_path / "a.svg")
