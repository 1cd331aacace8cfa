import numpy as np
import pytest

from relieffab.fittings import Edge, Frame, Hole
from relieffab.stock import Stock
from relieffab.template.marks import LIGHT, Line, Text
from relieffab.template.model import COLOURS, FOOT, edges_of, foot_marks, make_template, panel_marks


@pytest.fixture
def template(bowl, strokes):
    return make_template(bowl, strokes, Stock(60.0, 40.0, 12.0), line_width=0.6, name="bowl.ply")


def test_what_lies_on_the_panel(template):
    layers = panel_marks(template)
    assert list(layers) == [
        "panel", "depth contours", "outline", "suggestive", "principal-highlight", "depths",
    ]  # fmt: skip
    outline = layers["panel"][0]
    assert outline.points.max(axis=0).tolist() == [60, 40]
    assert [line.colour for line in layers["depth contours"]] == COLOURS
    widths = [layers[kind][0].width for kind in ("outline", "suggestive")]
    assert widths == [0.6, 0.3]
    assert layers["outline"][0].closed
    assert layers["principal-highlight"][0].colour == LIGHT


def test_the_foot_tells_scale_depths_and_title_in_its_height(template):
    marks = foot_marks(template, 5.0, 7.0)
    words = {mark.words for mark in marks if isinstance(mark, Text)}
    assert words >= {"100 mm", "0.6", "1.2", "1.8", "2.4"}
    assert "bowl.ply: 60 x 40 mm, 3 mm deep, contours every 0.6 mm" in words
    high = [mark.points[:, 1] for mark in marks if isinstance(mark, Line)]
    assert np.concatenate(high).min() >= 7
    assert np.concatenate(high).max() <= 7 + FOOT


def test_a_shaped_panel_shows_outline_frame_and_holes(bowl):
    stock = Stock(
        *(60.0, 40.0, 12.0),
        shape="round",
        frame=Frame(6.0, -2.0, Edge("chamfer", 1.0)),
        holes=(Hole((30.0, 20.0), 4.0, 8.0),),
    )
    edges = edges_of(stock)
    sizes = sorted(tuple(np.ptp(edge, axis=0)) for edge in edges)
    assert np.allclose(sizes, [(4, 4), (8, 8), (46, 26), (48, 28), (60, 40)], atol=0.02)
    marks = panel_marks(make_template(bowl, (), stock))["panel"]
    assert len([mark for mark in marks if mark.closed]) == 5
