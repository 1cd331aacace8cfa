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


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("", "no path"),
        ('<image href="a.png" width="9" height="9"/>', "1 pictures left out"),
        ("<text>hello</text>", "1 texts left out"),
        ('<path d="" fill="none" stroke="black"/>', "no path"),
        ('<path d="M0 0L1e999 3" stroke="black"/>', "not numbers"),
    ],
)
def test_nothing_to_carve_is_an_error(tmp_path, body, said):
    with pytest.raises(InputError, match=said):
        read_svg(svg(tmp_path, body))


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
