import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.errors import InputError
from relieffab.outline import Outline

OUTLINES = [
    Outline("rectangle", 30, 20),
    Outline("rectangle", 30, 20, 6),
    Outline("round", 30, 20),
    Outline("arched", 20, 30),
    Outline("arched", 20, 30, 4),
]


def shoelace(points):
    x, y = points.T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


@pytest.mark.parametrize(
    ("outline", "area"),
    [
        (OUTLINES[0], 600),
        (OUTLINES[1], 600 - (4 - np.pi) * 36),
        (OUTLINES[2], np.pi * 150),
        (OUTLINES[3], 400 + np.pi * 50),
        (OUTLINES[4], 400 + np.pi * 50 - (4 - np.pi) / 2 * 16),
    ],
)
def test_polygon_has_the_outline_s_area(outline, area):
    assert shoelace(outline.polygon(error=1e-5)) == pytest.approx(area, rel=1e-5)


@pytest.mark.parametrize("outline", OUTLINES)
@given(by=st.floats(-2, 9), t=st.floats(0, 1))
def test_inside_and_polygon_agree(outline, by, t):
    """A corner of the polygon, moved a little in or out along a ray from the middle."""
    polygon = outline.polygon(by=by, error=1e-4)
    middle = np.array([outline.width, outline.height]) / 2
    corner = polygon[int(t * (len(polygon) - 1))]
    for share, inside in ((0.999, True), (1.001, False)):
        x, y = middle + share * (corner - middle)
        assert outline.inside(x, y, by=by) == inside


@pytest.mark.parametrize("outline", [o for o in OUTLINES if o.kind != "round"])
def test_an_inset_is_parallel(outline):
    outer, inner = outline.polygon(error=1e-5), outline.polygon(by=3, error=1e-2)
    # Along the outer one, points on its sides, too.
    share = np.linspace(0, 1, 200)[:, None, None]
    walk = (outer + share * (np.roll(outer, -1, axis=0) - outer)).reshape(-1, 2)
    away = [np.hypot(*(walk - corner).T).min() for corner in inner]
    assert np.min(away) == pytest.approx(3, abs=2e-2)
    assert np.max(away) < 3 * np.sqrt(2) + 1e-6


def test_places_come_in_arrays():
    found = Outline("round", 30, 20).inside(
        np.array([15.0, 1.0, 29.9]), np.array([10.0, 1.0, 10.0])
    )
    assert found.tolist() == [True, False, True]


@pytest.mark.parametrize(
    ("given_", "message"),
    [
        (("oval", 30, 20), "(?s)no outline of that name.*round"),
        (("arched", 30, 15), "too low for an arch"),
        (("round", 30, 20, 1), "no corners"),
        (("rectangle", 30, 20, 10), "no room for such corners"),
        (("arched", 20, 14, 4), "no room for such corners"),
        (("rectangle", 30, 20, -1), "no room for such corners"),
    ],
)
def test_what_is_no_outline_is_refused(given_, message):
    with pytest.raises(InputError, match=message):
        Outline(*given_)


@pytest.mark.parametrize("outline", OUTLINES)
def test_from_its_room_on_nothing_is_inside(outline):
    middle = np.array([outline.width, outline.height]) / 2
    assert outline.inside(*middle, by=outline.room - 0.01).shape == ()
    for by in (outline.room, 2 * outline.room):
        assert not outline.inside(*middle, by=by)
        assert outline.inside(np.zeros((3, 1)), np.zeros(4), by=by).shape == (3, 4)
