import numpy as np
import pytest

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
