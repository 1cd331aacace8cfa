import numpy as np
import pytest
from lxml import etree

from relieffab.errors import InputError
from relieffab.layers.lines.svg import strokes_from_svg, strokes_to_svg
from relieffab.layers.model import Stroke


def test_strokes_come_back_from_their_svg():
    rng = np.random.default_rng(0)
    ring = Stroke(rng.uniform(1, 89, (5, 2)), "outline", np.ones(5), closed=True)
    line = Stroke(rng.uniform(1, 89, (3, 2)), "suggestive", np.ones(3))
    back = strokes_from_svg(strokes_to_svg([line, ring], (120.0, 90.0)))
    assert {s.kind: s.closed for s in back} == {"outline": True, "suggestive": False}
    for stroke in back:
        original = ring if stroke.closed else line
        np.testing.assert_allclose(stroke.points, original.points, atol=6e-4)


@pytest.mark.parametrize(
    "text",
    [
        "not xml",
        '<svg xmlns="http://www.w3.org/2000/svg"><g id="a"><path d="M 1,1 2,2"/></g></svg>',
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><g><path d="C 1,1"/></g></svg>',
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><g><path d=""/></g></svg>',
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        '<g transform="scale(2)"><path d="M 1,1 2,2"/></g></svg>',
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        '<g><g><path d="M 1,1 2,2"/></g></g></svg>',
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        '<g><path d="M nan,1 2,2"/></g></svg>',
    ],
)
def test_other_drawings_are_refused(text):
    with pytest.raises(InputError):
        strokes_from_svg(text)


def test_svg_is_in_mm_with_y_down_and_a_layer_per_kind():
    strokes = [
        Stroke(np.array([[1.0, 2], [3, 4]]), "contour", np.ones(2)),
        Stroke(np.array([[0.0, 0], [10, 0], [10, 5]]), "outline", np.ones(3), closed=True),
    ]
    root = etree.fromstring(strokes_to_svg(strokes, (120.0, 90.0)).encode())
    assert (root.get("width"), root.get("height")) == ("120mm", "90mm")
    assert root.get("viewBox") == "0 0 120 90"
    groups = list(root)
    assert [g.get("id") for g in groups] == ["outline", "contour"]
    label = "{http://www.inkscape.org/namespaces/inkscape}"
    assert {g.get(label + "groupmode") for g in groups} == {"layer"}
    assert groups[0][0].get("d") == "M 0.000,90.000 10.000,90.000 10.000,85.000 Z"
    assert groups[1][0].get("d") == "M 1.000,88.000 3.000,86.000"


def test_secondary_lines_are_finer_and_highlights_no_ink():
    points = np.array([[1.0, 2], [3, 4]])
    kinds = ["contour", "suggestive", "principal-highlight"]
    text = strokes_to_svg([Stroke(points, kind, np.ones(2)) for kind in kinds], (9.0, 9.0))
    groups = list(etree.fromstring(text.encode()))
    assert [g.get("stroke-width") for g in groups] == ["0.3", "0.15", "0.15"]
    assert [g.get("stroke") for g in groups] == ["black", "black", "goldenrod"]
