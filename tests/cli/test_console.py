from pathlib import Path

import pytest

from relieffab.cli import console

FOUND = {
    "spacing_mm": 0.9447,
    "depth_mm": 0.131,
    "area_mm2": 1610.0,
    "within_tolerance": 0.9992,
    "left_p99_mm": 0.0176,
    "tolerance_mm": 0.05,
}
NOTHING = {**dict.fromkeys(FOUND), "area_mm2": 0.0, "tolerance_mm": 0.05}


@pytest.mark.parametrize(
    ("found", "line"),
    [
        (
            FOUND,
            "marks    of the figure: 0.94 mm apart, 0.13 mm deep; their cutter leaves at most "
            "0.05 mm on 99.9% of them",
        ),
        ({**FOUND, "spacing_mm": None}, "marks    of the figure: 0.13 mm deep;"),
        (NOTHING, "marks    none on the figure: there is no room for one"),
    ],
)
def test_marks_are_told_as_measured(found, line, capsys):
    report = {"settings": {}, "style": {"measured": {"figure": found}}}
    assert console.result(report, Path("out"), as_json=False) == 0
    assert line in capsys.readouterr().out
