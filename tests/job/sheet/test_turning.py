import numpy as np
import pytest

from relieffab.job.sheet import turning
from relieffab.round import Round
from relieffab.stock import Stock

CUP = Round(60, 45, 40, bore=24, floor=5)


def points(drawing, kind):
    """The corners of each polyline of a kind."""
    paths = [line.path for line in drawing.lines if line.kind == kind and " a" not in line.path]
    corners = [path.removeprefix("M").removesuffix(" Z").split(" L") for path in paths]
    return [np.array([[float(n) for n in c.split()] for c in path]) for path in corners]


def texts(drawing):
    return {word.text for word in drawing.words}


def test_along_the_axis_bore_and_floor_are_to_scale():
    stock = Stock(45, 60, 8, (22.5, 30, -20.0), radius=20)
    drawing = turning.along(stock, CUP, 3.0, (-2.0, 40.0), 5.0)
    (outline,) = points(drawing, "stock")
    bore, relief = points(drawing, "cut")
    scale = np.ptp(outline[:, 0]) / 45
    assert np.ptp(outline[:, 1]) == pytest.approx(40 * scale, abs=0.2)
    assert np.ptp(bore[:, 1]) == pytest.approx(24 * scale, abs=0.2)
    assert outline[:, 0].max() - bore[:, 0].max() == pytest.approx(5 * scale, abs=0.2)
    # The relief ends with the stock, whatever the cutter runs over.
    assert relief[:, 0].min() == outline[:, 0].min()
    assert np.ptp(relief[:, 0]) == pytest.approx(40 * scale, abs=0.2)
    zero = points(drawing, "zero")[0][0]
    assert zero == pytest.approx(outline.mean(axis=0), abs=0.2)
    assert {"45 mm", "40 mm", "3 mm deep", "rapids at Z 25", "X", "Z"} <= texts(drawing)


def test_without_relief_or_machine_there_is_only_the_stock():
    drawing = turning.along(Stock(45, 60, 20, radius=20), Round(60, 45, 40), 0.0, (0, 45))
    assert points(drawing, "cut") == []
    assert not any("rapids" in word or "deep" in word for word in texts(drawing))


@pytest.mark.parametrize(("y", "side"), [(0.0, -1), (60.0, 1)])
def test_across_the_axis_the_figure_lies_where_y_says(y, side):
    drawing = turning.across(Stock(45, 60, 20, (0, y, 0), radius=20), Round(60, 45, 40), 3.0, "Y")
    zero = points(drawing, "zero")[0][0]
    (relief,) = points(drawing, "cut")
    # The operator is on the left: what lies at Y below 0 is on his side of the top.
    middle = relief[len(relief) // 4, 0] - zero[0]
    assert np.sign(middle) == side
    angle = 60 / 20
    furthest = zero[0] + side * turning.DISC * np.sin(min(angle, np.pi / 2))
    assert abs(relief[:, 0] - furthest).min() < 0.1


def test_work_turns_against_the_way_of_the_cutter():
    stock, bent = Stock(45, 60, 20, radius=20), Round(60, 45, 40)
    ends = {}
    for letter in "AY":
        drawing = turning.across(stock, bent, 3.0, letter)
        arc = points(drawing, "turn")[0]
        ends[letter] = arc[-1, 0] - arc[0, 0]
        assert f"turns so as {letter} grows" in texts(drawing)
    assert ends["A"] > 0 > ends["Y"]


@pytest.mark.parametrize("long", [5.0, 45.0, 400.0])
def test_top_and_foot_are_told_apart_on_any_length(long):
    bent = Round(60, long, 40)
    drawing = turning.along(Stock(long, 60, 20, radius=20), bent, 3.0, (0, long), 5.0)
    ends = {word.text: word for word in drawing.words if word.text.startswith("figure")}
    assert ends["figure's top"].anchor == "end"
    assert ends["figure's foot"].anchor == "start"
    assert ends["figure's foot"].x - ends["figure's top"].x >= 7.9


def test_where_no_machine_is_known_nothing_turns():
    drawing = turning.across(Stock(45, 60, 20, radius=20), Round(60, 45, 40), 3.0, "")
    assert points(drawing, "turn") == []
    assert texts(drawing) == {"Z", "40 mm", "operator's side"}


def test_work_zero_on_the_axis_is_drawn_there():
    stock = Stock(45, 60, 20, (0, 0, -20), radius=20)
    drawing = turning.across(stock, Round(60, 45, 40), 3.0, "A")
    face = turning.across(Stock(45, 60, 20, radius=20), Round(60, 45, 40), 3.0, "A")
    down = points(drawing, "zero")[0][0] - points(face, "zero")[0][0]
    assert down == pytest.approx([0, turning.DISC], abs=0.1)
