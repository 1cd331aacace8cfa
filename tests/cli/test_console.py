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


def test_marks_of_a_composed_panel_are_told_relief_by_relief(capsys):
    styles = [{"relief": name, "measured": {"figure": NOTHING}} for name in ("horse", "cat")]
    report = {"settings": {}, "reliefs": [{"styles": [style]} for style in styles]}
    assert console.result(report, Path("out"), as_json=False) == 0
    out = capsys.readouterr().out
    assert "none on the figure of horse:" in out
    assert "none on the figure of cat:" in out
