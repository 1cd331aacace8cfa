import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.errors import InputError
from relieffab.template.pages import EDGE, OVERLAP, PAPERS, tile

FOOT = 24.0


def covers(tiling, page):
    return np.array([page.x, page.y]), np.array([page.x, page.y]) + tiling.window


def test_a_small_drawing_takes_one_upright_page_and_lies_in_its_middle():
    tiling = tile((0.0, 0.0), (120.0, 90.0), "a4", FOOT)
    assert (tiling.paper, tiling.counts, tiling.last) == ((210.0, 297.0), (1, 1), "A1")
    low, high = covers(tiling, tiling.pages()[0])
    assert (low + high) / 2 == pytest.approx([60, 45])
    assert tiling.joints() == []


def test_pages_are_turned_where_that_saves_some():
    assert tile((0.0, 0.0), (260.0, 120.0), "a4", FOOT).paper == (297.0, 210.0)


def test_pages_are_named_from_the_far_left_and_overlap():
    tiling = tile((0.0, 0.0), (360.0, 300.0), "a4", FOOT)
    pages = tiling.pages()
    assert [page.name for page in pages] == ["A1", "B1", "A2", "B2"]
    assert tiling.last == "B2"
    assert pages[1].x - pages[0].x == pytest.approx(tiling.window[0] - OVERLAP)
    assert pages[0].y - pages[2].y == pytest.approx(tiling.window[1] - OVERLAP)


@settings(deadline=None)
@given(
    st.tuples(st.floats(1, 900), st.floats(1, 900)),
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.sampled_from(sorted(PAPERS)),
)
def test_pages_cover_all_and_neighbours_share_their_crosses(size, low, paper):
    high = low[0] + size[0], low[1] + size[1]
    tiling = tile(low, high, paper, FOOT)
    assert sorted(tiling.paper) == sorted(PAPERS[paper])
    assert tiling.window == pytest.approx(
        (tiling.paper[0] - 2 * EDGE, tiling.paper[1] - 2 * EDGE - FOOT)
    )
    low_ends, high_ends = np.transpose([covers(tiling, page) for page in tiling.pages()], (1, 0, 2))
    assert (low_ends.min(axis=0) <= np.array(low) + 1e-6).all()
    assert (high_ends.max(axis=0) >= np.array(high) - 1e-6).all()
    for joint in tiling.joints():
        assert ((low_ends < joint) & (joint < high_ends)).all(axis=1).sum() >= 2


def test_a_wall_is_refused():
    with pytest.raises(InputError, match="too many pages"):
        tile((0.0, 0.0), (90000.0, 100.0), "letter", FOOT)
