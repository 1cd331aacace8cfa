import pytest

from relieffab.job.sheet.drawings import count_positions, drawings
from relieffab.job.sheet.pictures import Picture
from relieffab.round import Curved, Round
from relieffab.stock import Stock


def test_a_flat_stock_is_seen_from_above_and_from_the_side(report):
    words = [words for words, _ in drawings(report, Stock(120, 90, 12), None, 3.0, None)]
    assert words == ["", "From the operator's side; widths not to scale"]
    assert count_positions(report) == count_positions({}) == 1


def test_a_round_stock_is_seen_laid_out_along_and_across(made):
    report = made(round="40mm", size="60x45mm", machine="altmill-4x4-rotary")
    report["relief"] |= {"origin_mm": [0.0, 45.0], "rows": 46, "cols": 31, "pitch_mm": 1.0}
    stock, kept = Stock.of(report["slab"]), Picture("plan", "data:,", "")
    (_, face), (_, along), (across, _) = drawings(report, stock, Round(60, 45, 40), 3.0, kept)
    assert "60 of 125.66 mm round the face, 172°" in across
    assert "rapids at Z 5" in {word.text for word in along.words}
    # 30 mm on the left of the panel lie farthest from the right edge: at the foot of the page.
    inset = face.insets[0]
    assert inset.height == pytest.approx(inset.width / 45 * 30)
    outline = next(line.path for line in face.lines if line.kind == "stock")
    foot = max(float(corner.split()[1]) for corner in outline[1:-2].split(" L"))
    assert inset.y + inset.height == pytest.approx(foot, abs=0.1)


def test_a_curved_board_has_its_own_drawing():
    board = Curved(60, 45, 12, 120)
    ((words, _),) = drawings({}, Stock(60, 45, board.wall), board, 3.0, None)
    assert words == "From the near side, to scale"
