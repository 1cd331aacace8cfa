from math import cos, pi

import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.round import Curved, Round, check_depth, check_on, chord


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((120, 90, 38), "wider than the way round"),
        ((120, 90, 0), "diameter cannot be 0"),
        ((120, 90, 40, 40), "no wall"),
        ((120, 90, 40, -1), "no wall"),
        ((120, 90, 40, 30, 90), "no bore"),
        ((120, 90, 40, 0, 5), "but no bore"),
        ((float("nan"), 90, 40), "width cannot be nan"),
    ],
)
def test_a_round_stock_that_cannot_be(values, words):
    with pytest.raises(InputError, match=words):
        Round(*values)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((120, 90, 16, 76), "too strongly"),
        ((120, 90, 5, 300), "through the back"),
        ((120, 90, -5, 300), "thickness cannot be"),
    ],
)
def test_a_board_that_cannot_be(values, words):
    with pytest.raises(InputError, match=words):
        Curved(*values)


def test_walls():
    assert Round(120, 90, 40, 30).wall == 5
    assert Round(120, 90, 40).wall == 20
    board = Curved(120, 90, 16, 300)
    assert board.wall == pytest.approx(16 - 300 * (1 - cos(0.2)))


def test_all_round_only_where_the_edges_meet():
    assert Round(80 * pi, 20, 80).all_round
    assert not Round(80 * pi - 0.01, 20, 80).all_round


def test_a_relief_deeper_than_the_wall_is_refused():
    check_depth(Round(120, 90, 40, 30), 4.9)
    with pytest.raises(InputError, match="through the stock"):
        check_depth(Round(120, 90, 40, 30), 5.0)


def test_a_relief_beyond_its_panel_is_refused():
    stock = Round(20, 10, 40)
    check_on(stock, Grid(10, 20, 1.0, (0.0, 10.0)))
    for grid in (Grid(10, 21, 1.0, (0.0, 10.0)), Grid(11, 20, 1.0, (0.0, 10.0))):
        with pytest.raises(InputError, match="reaches beyond"):
            check_on(stock, grid)


def test_a_chord_is_off_by_the_error_asked_for():
    assert 40 * (1 - cos(chord(40, 0.005) / 2)) == pytest.approx(0.005)
