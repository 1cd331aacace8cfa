from dataclasses import replace

import pytest
from lxml import etree

from relieffab.stock import Stock
from relieffab.template.model import make_template
from relieffab.template.svg import to_svg

LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"


@pytest.fixture
def template(bowl, strokes):
    return make_template(bowl, strokes, Stock(60.0, 40.0, 12.0), name="bö<wl>\x02.ply")


def parsed(template):
    return etree.fromstring(to_svg(template).encode())


def points(path):
    pairs = path.get("d").removeprefix("M ").removesuffix(" Z").split()
    return [tuple(float(v) for v in pair.split(",")) for pair in pairs]


def test_the_sheet_is_in_mm_and_a_layer_each_kind_of_mark(template):
    root = parsed(template)
    wide, high = (float(root.get(side).removesuffix("mm")) for side in ("width", "height"))
    assert root.get("viewBox") == f"0 0 {wide:g} {high:g}"
    names = [group.get(LABEL) for group in root.iterfind("{*}g")]
    assert names[:3] == ["panel", "depth contours", "outline"]
    assert names[-2:] == ["depths", "scale"]
    assert root.find("{*}title").text.startswith("bö<wl>?.ply: 60 x 40 mm")
    for path in root.iter("{*}path"):
        assert all(0 <= x <= wide and 0 <= y <= high for x, y in points(path))


def test_panel_and_scale_are_true_to_size(template):
    layers = {group.get(LABEL): group for group in parsed(template).iterfind("{*}g")}
    corners = points(layers["panel"][0])
    assert max(x for x, _ in corners) - min(x for x, _ in corners) == pytest.approx(60)
    assert max(y for _, y in corners) - min(y for _, y in corners) == pytest.approx(40)
    (x0, y0), (x1, y1) = points(layers["scale"][0])
    assert (x1 - x0, y1 - y0) == (pytest.approx(100), 0)
    # The middle of the bowl is the middle of the panel, and Y points down on paper.
    ring = points(layers["outline"][0])
    middle = sum(y for _, y in ring) / len(ring)
    assert middle == pytest.approx(sum(y for _, y in corners) / 4, abs=0.01)


def test_without_strokes_it_is_a_map_of_the_depth(template):
    names = [g.get(LABEL) for g in parsed(replace(template, strokes=())).iterfind("{*}g")]
    assert names == ["panel", "depth contours", "depths", "scale"]


def test_the_same_template_gives_the_same_text(template):
    assert to_svg(template) == to_svg(template)
