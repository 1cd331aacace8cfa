import pytest

from relieffab.job.sheet.drawing import Drawing


@pytest.fixture
def page():
    return Drawing(100, 100, "a page")


def test_paths_of_lines_and_circles(page):
    page.polyline("stock", [(0, 0), (1, 2)], closed=True)
    page.circle("hole", (10, 20), 3)
    assert page.lines[0].path == "M0.0 0.0 L1.0 2.0 Z"
    assert page.lines[1].path.startswith("M7.0 20.0 a3.0 3.0 0 0 1 6.0 0")


def test_an_arrow_has_its_head_at_its_end(page):
    page.arrow("zero", (0, 50), (40, 50))
    assert page.lines[1].path == "M32.0 53.2 L40.0 50.0 L32.0 46.8"


def test_a_short_measure_has_its_word_beside_it(page):
    page.down(10, 90, 20, "80 mm", from_x=40)
    page.down(10, 20, 60, "10 mm", from_x=40)
    page.across(10, 90, 95, "80 mm", from_y=80)
    long, short, wide = page.words
    assert (long.upright, long.y) == (True, 50)
    assert (short.upright, short.anchor, short.x) == (False, "start", 66)
    assert (wide.x, wide.y) == (50, 91)
