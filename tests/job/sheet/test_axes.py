from math import pi

import pytest

from relieffab.job.sheet import tools
from relieffab.job.sheet.axes import second_of

SIZES = {"round": "40mm", "size": "60x45mm"}


def test_a_flat_stock_has_a_y(report):
    assert second_of(report) == ("Y", "mm", 1.0, False)
    assert second_of({}).letter == "Y"


def test_a_grows_against_y_in_degrees(made):
    report = made(**SIZES, machine="altmill-4x4-rotary")
    second = second_of(report)
    assert (second.letter, second.unit, second.turns) == ("A", "°", True)
    assert second.per_mm * 40 * pi == pytest.approx(-360)
    for part in report["programs"]:
        part["bounds_mm"] = [[0.0, -20 * pi, -3.0], [45.0, 0.0, 5.0]]
    assert tools.programs(report)[0]["bounds"] == ["0 to 45", "0 to 180", "-3 to 5"]
    row = tools.reaches(report)[1]
    assert row == {"axis": "A", "span": "0 to 180 °", "needs": "180°", "has": "no end"}


def test_y_round_the_face_stays_in_mm_and_has_no_end(made):
    report = made(**SIZES, machine="3018-prover-rotary")
    assert second_of(report) == ("Y", "mm", 1.0, True)
    row = tools.reaches(report)[1]
    assert row == {"axis": "Y", "span": "12 to 80 mm", "needs": "68 mm", "has": "no end"}
