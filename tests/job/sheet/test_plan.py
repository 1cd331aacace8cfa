from dataclasses import replace

import numpy as np
import pytest

from relieffab.fittings import Frame, Hole, Keyhole
from relieffab.job.sheet import plan
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

STOCK = Stock(120, 90, 12)


def kinds(drawing):
    return [line.kind for line in drawing.lines]


def points(drawing, kind):
    path = next(line.path for line in drawing.lines if line.kind == kind)
    corners = path.removeprefix("M").removesuffix(" Z").split(" L")
    return np.array([[float(n) for n in corner.split()] for corner in corners])


def test_the_stock_is_to_scale_and_measured():
    drawing = plan.draw(plan.Plan(STOCK))
    corners = points(drawing, "stock")
    assert np.ptp(corners[:, 0]) / np.ptp(corners[:, 1]) == pytest.approx(120 / 90, rel=1e-2)
    assert {"120 mm", "90 mm", "X", "Y"} <= {word.text for word in drawing.words}
    # Work zero on the near left corner: left, and at the bottom of the page.
    zero = points(drawing, "zero")[0]
    assert zero == pytest.approx([corners[:, 0].min(), corners[:, 1].max()], abs=0.06)


def test_everything_lies_on_the_page():
    stock = Stock(90, 120, 12, (45, 60, 0), shape="arched", frame=Frame(8, 3), corner=4)
    stock = replace(stock, holes=(Hole((4, 20), 3, 5),), keyholes=(Keyhole((45, 80)),))
    bounds = np.array([-30.0, -40, -3]), np.array([30.0, 40, 5])
    bounds = stock.to_panel(bounds[0]), stock.to_panel(bounds[1])
    drawing = plan.draw(plan.Plan(stock, None, bounds, (140, 150, 40)))
    assert {"frame", "hole", "edge", "hidden", "bounds", "travel"} <= set(kinds(drawing))
    for kind in ("stock", "frame", "bounds", "travel", "zero"):
        at = points(drawing, kind)
        assert at.min() > 0
        assert (at < (drawing.width, drawing.height)).all()


def test_a_travel_much_larger_than_the_stock_is_not_drawn():
    bounds = np.zeros(3), np.array([120.0, 90, 0])
    assert "travel" not in kinds(plan.draw(plan.Plan(STOCK, None, bounds, (800, 800, 100))))
    assert "travel" in kinds(plan.draw(plan.Plan(STOCK, None, bounds, (150, 150, 100))))


def test_a_turned_stock_is_drawn_as_it_lies():
    position = Position(2, 2, (50.0, 0.0), (120.0, 90.0), (120.0, 90.0), turned=True)
    stock = plan.lying(STOCK, position)
    seen = "data:,", np.array([80.0, 10.0]), np.array([110.0, 30.0])
    drawing = plan.draw(plan.Plan(stock, position, picture=seen))
    outline, window = points(drawing, "stock"), points(drawing, "window")
    assert window[:, 0].min() == pytest.approx(outline[:, 0].min(), abs=0.1)
    inset = drawing.insets[0]
    assert inset.turn == 180
    # 80 to 110 mm from the left is 10 to 40 mm once it is turned.
    scale = np.ptp(outline[:, 0]) / 120
    assert inset.x - outline[:, 0].min() == pytest.approx(10 * scale, abs=0.2)
    assert points(drawing, "zero")[0][0] == pytest.approx(outline[:, 0].min(), abs=0.1)


def test_bounds_of_programs_are_brought_to_the_panel():
    stock = replace(STOCK, work_zero=(120.0, 90.0, 0.0), turned=True)
    low, high = plan.bounds_of([{"bounds_mm": [[0, 0, -3], [30, 20, 5]]}], stock)
    assert low.tolist() == [90, 70, -3]
    assert high.tolist() == [120, 90, 5]
    assert plan.bounds_of([], stock) is None


def test_a_face_laid_out_is_as_the_cutter_meets_it():
    stock = Stock(45, 60, 20, (0.0, 0.0, 0.0), radius=20)
    # All that a program cuts lies at Y below 0 where work zero is on the figure's right edge.
    box = plan.bounds_of([{"bounds_mm": [[0, -60, -3], [45, -50, 5]]}], stock)
    assert (box[0].tolist(), box[1].tolist()) == ([0, 50, -3], [45, 60, 5])
    seen = "data:,", np.array([5.0, 40.0]), np.array([15.0, 60.0])
    drawing = plan.draw(plan.Plan(stock, None, box, (400, 300, 80), seen, "A"))
    outline, bounds = points(drawing, "stock"), points(drawing, "bounds")
    zero = points(drawing, "zero")
    assert zero[0] == pytest.approx(outline.min(axis=0), abs=0.06)
    assert bounds[:, 1].max() == pytest.approx(outline[:, 1].max(), abs=0.06)
    assert "travel" not in kinds(drawing)
    # A grows against Y, which is up on the page.
    arrows = [line.path for line in drawing.lines if line.kind == "zero"]
    assert points(drawing, "zero")[1][0] > zero[0][0]
    assert float(arrows[2].split(" L")[1].split()[1]) > zero[0][1]
    assert {"A", "45 mm", "60 mm"} <= {word.text for word in drawing.words}
    inset = drawing.insets[0]
    scale = np.ptp(outline[:, 0]) / 45
    assert inset.turn == -90
    assert (inset.width, inset.height) == pytest.approx((10 * scale, 20 * scale), abs=0.2)
    lying = inset.lying
    assert (lying.width, lying.height) == (inset.height, inset.width)
    assert lying.x + lying.width / 2 == pytest.approx(inset.x + inset.width / 2)


@pytest.mark.parametrize("zero", [(0, 0), (45, 60), (45, 0), (0, 60), (22.5, 30)])
@pytest.mark.parametrize(("radius", "letter"), [(0.0, "Y"), (20.0, "Y"), (20.0, "A")])
def test_the_axes_of_work_zero_lie_on_the_page_wherever_it_is(zero, radius, letter):
    drawing = plan.draw(plan.Plan(Stock(45, 60, 12, (*zero, 0.0), radius=radius), letter=letter))
    for line in drawing.lines:
        if line.kind == "zero":
            at = [[float(n) for n in c.split()] for c in line.path.removeprefix("M").split(" L")]
            assert np.min(at) > 0
            assert (np.array(at) < (drawing.width, drawing.height)).all()
    for word in drawing.words:
        assert 0 < word.x < drawing.width
        assert 8 < word.y < drawing.height
