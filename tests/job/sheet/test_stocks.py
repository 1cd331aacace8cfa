from relieffab.fittings import Frame
from relieffab.job.sheet.stocks import measures, zero
from relieffab.job.sheet.words import sides
from relieffab.round import Curved, Round
from relieffab.stock import Stock


def test_work_zero_in_words():
    assert zero(Stock(120, 90, 12)) == "the stock's near left corner, on the stock's face"
    assert zero(Stock(120, 90, 12, (60, 45, -12))) == (
        "60 mm right and 45 mm up from the stock's near left corner, under the stock, on the table"
    )


def test_work_zero_of_a_round_stock_is_told_from_its_figure():
    assert zero(Stock(45, 60, 10, (22.5, 30, 0), radius=20)) == (
        "22.5 mm along the axis from the figure's top, 30 mm round the face from its right edge, "
        "on the face; the stock is 40 mm thick and turns about X"
    )
    assert "on the axis" in zero(Stock(45, 60, 10, (0, 0, -20), radius=20))


def test_measures_are_those_of_its_form():
    assert measures(Stock(120, 90, 12, frame=Frame(8, 2))) == sides((120, 90, 12))
    assert measures(Stock(120, 90, 12, shape="arched")) == f"{sides((120, 90, 12))}, arched"
    assert measures(Stock(45, 60, 20, radius=20), Round(60, 45, 40)) == (
        "round, 40 mm thick, 45 mm long"
    )
    # A curved board is as thick as its middle, not as the sides that a relief must not cut through.
    board = Curved(60, 45, 12, 120)
    assert measures(Stock(60, 45, board.wall), board) == (
        f"{sides((60, 45, 12))}, its face curved along X with a radius of 120 mm"
    )


def test_a_curved_board_has_its_zero_where_it_is_highest():
    board = Stock(58, 45, 12, curve=120)
    assert zero(board) == (
        "the stock's near left corner, on the middle of the stock's face, its highest"
    )
