from dataclasses import replace

import numpy as np
import pytest

from relieffab import profiles
from relieffab.grid import Grid
from relieffab.layers.model import Stroke
from relieffab.relief.laid import laid, laid_marks, laid_strokes, parted, parted_line, upright
from relieffab.relief.model import Relief
from relieffab.relief.style.model import Marks
from relieffab.round import Curved, Round
from relieffab.stock import Stock

STOCK = Stock(10.0, 20.0, 5.0, work_zero=(2.0, 3.0, 0.0), radius=8.0)


@pytest.fixture
def relief():
    heights = -np.random.default_rng(1).random((5, 8))
    return Relief(Grid(4, 7, 0.5, (3.0, 6.0)), heights, np.ones((4, 7), bool), 1.0)


def test_every_point_of_the_surface_is_where_x_and_y_change_places(relief):
    milled = laid(relief, STOCK)
    x, y = np.random.default_rng(2).uniform([3, 4], [6.5, 6], (50, 2)).T
    # The triangles are the same ones: between nodes, too.
    found = milled.height_at(STOCK.width - y, STOCK.height - x)
    np.testing.assert_allclose(found, relief.height_at(x, y), atol=1e-12)


def test_upright_undoes_it(relief):
    back = upright(laid(relief, STOCK), STOCK)
    assert back.grid == relief.grid
    np.testing.assert_array_equal(back.heights, relief.heights)


def test_on_a_flat_stock_nothing_happens(relief):
    flat = Stock(10.0, 20.0, 5.0)
    assert laid(relief, flat) is relief and upright(relief, flat) is relief
    strokes = [Stroke(np.array([[1.0, 2.0]]), "crease", np.ones(1))]
    assert laid_strokes(strokes, relief, flat) is strokes


def test_strokes_go_where_their_relief_goes():
    (found,) = laid_strokes([Stroke(np.array([[1.0, 2.0]]), "crease", np.ones(1))], None, STOCK)
    np.testing.assert_array_equal(found.points, [[8.0, 19.0]])


def test_marks_go_where_their_relief_goes(relief):
    marks = Marks(profiles.cutter("vee-60"), relief, (np.array([[1.0, 2.0], [3.0, 2.0]]),))
    found = laid_marks(marks, relief, STOCK)
    np.testing.assert_array_equal(found.lines[0], [[8.0, 19.0], [8.0, 17.0]])
    np.testing.assert_array_equal(found.smooth.heights, laid(relief, STOCK).heights)
    assert laid_marks(marks, relief, Stock(10.0, 20.0, 5.0)) is marks


def test_a_round_tips_middle_stands_over_that_of_its_mark_on_a_curved_board():
    board = Curved(40.0, 12.0, 9.0, 40.0)
    stock = Stock(board.breadth, board.height, board.thickness, curve=board.radius)
    grid = Grid(12, 40, 1.0, (0.0, 12.0))
    smooth = Relief(grid, np.zeros(grid.node_shape), np.zeros(grid.shape, bool), 2.0)
    pecked = replace(smooth, heights=np.full(grid.node_shape, -0.3))
    marks = Marks(profiles.cutter("ball-2"), smooth, (np.array([[34.0, 6.0]]),))
    # 14 mm beside the board's middle, 1 mm above the bottom of the mark.
    across = board.breadth / 2 + (40.0 - 0.3 + 1.0) * np.sin(14.0 / 40.0)
    found = laid_marks(marks, pecked, stock).lines[0]
    np.testing.assert_allclose(found, [[across, 6.0]], atol=1e-12)


def test_programs_carve_what_the_solid_shows_and_not_its_mirror_image():
    # Points on the flat panel; where the solid has them; where a program sends the cutter.
    panel = np.array([[9.0, 4.0, 0.0], [13.0, 4.0, 0.0], [9.0, 8.0, 0.0], [9.0, 4.0, -1.0]])
    solid = Round(20.0, 10.0, 16.0).bend.bent(panel)
    milled = np.column_stack([10.0 - panel[:, 1], 20.0 - panel[:, 0], panel[:, 2]])
    x, y, z = STOCK.to_work(milled).T
    a = -y / 8.0  # A turns the cutter about X: from Z to -Y
    cut = np.column_stack([x, -(8.0 + z) * np.sin(a), (8.0 + z) * np.cos(a)])
    chirality = [np.linalg.det(points[1:] - points[0]) for points in (solid, cut)]
    assert chirality[0] == pytest.approx(chirality[1])
    one, other = (np.linalg.norm(points[:, None] - points[None], axis=2) for points in (solid, cut))
    np.testing.assert_allclose(one, other)


def test_a_line_across_the_seam_is_parted_there():
    line = Stroke(
        np.array([[18.0, 0.0], [21.0, 3.0], [19.0, 5.0]]), "crease", np.array([0, 0.6, 1])
    )
    one, two, three = parted(line, 20.0)
    np.testing.assert_allclose(one.points, [[18, 0], [20, 2]])
    np.testing.assert_allclose(two.points, [[0, 2], [1, 3], [0, 4]])
    np.testing.assert_allclose(three.points, [[20, 4], [19, 5]])
    np.testing.assert_allclose(two.strength, [0.4, 0.6, 0.8])


def test_the_lines_of_marks_are_parted_and_pecks_brought_round():
    one, two = parted_line(np.array([[18.0, 0.0], [22.0, 4.0]]), 20.0)
    np.testing.assert_allclose(one, [[18, 0], [20, 2]])
    np.testing.assert_allclose(two, [[0, 2], [2, 4]])
    (peck,) = parted_line(np.array([[41.0, 3.0], [41.0, 3.0]]), 20.0)
    np.testing.assert_allclose(peck, [[1, 3], [1, 3]])


def test_a_ring_across_the_seam_becomes_open_halves():
    ring = Stroke(np.array([[-1.0, 0], [1, 0], [1, 1], [-1, 1]]), "crease", np.ones(4), closed=True)
    parts = parted(ring, 20.0)
    assert [part.closed for part in parts] == [False] * 3
    assert sorted(len(part.points) for part in parts) == [2, 3, 4]
    assert all((part.points[:, 0] >= 0).all() and (part.points[:, 0] <= 20).all() for part in parts)
    np.testing.assert_allclose(parts[0].points, [[19, 0], [20, 0]])


def test_a_line_a_turn_away_is_brought_back_whole():
    line = Stroke(np.array([[-18.0, 0.0], [-12.0, 3.0]]), "crease", np.ones(2), closed=True)
    (back,) = parted(line, 20.0)
    np.testing.assert_allclose(back.points, [[2, 0], [8, 3]])
    assert back.closed
