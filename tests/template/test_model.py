import numpy as np
import pytest

from relieffab.template.marks import LIGHT, Line, Text
from relieffab.template.model import COLOURS, FOOT, foot_marks, make_template, panel_marks


@pytest.fixture
def template(bowl, strokes):
    return make_template(bowl, strokes, (60.0, 40.0), line_width=0.6, name="bowl.ply")


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
