"""A figure from a depth map and a word in a font, on one panel, carved and judged."""

import json

import numpy as np
import pytest
from PIL import Image

from relieffab.cli.main import run


@pytest.fixture
def font(tmp_path):
    """A font of one thick bar."""
    from fontTools.fontBuilder import FontBuilder
    from fontTools.pens.ttGlyphPen import TTGlyphPen

    pen = TTGlyphPen(None)
    for k, point in enumerate([(100, 0), (100, 700), (400, 700), (400, 0)]):
        (pen.lineTo if k else pen.moveTo)(point)
    pen.closePath()
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder([".notdef", "I"])
    builder.setupCharacterMap({ord("I"): "I"})
    builder.setupGlyf({".notdef": TTGlyphPen(None).glyph(), "I": pen.glyph()})
    builder.setupHorizontalMetrics({".notdef": (500, 0), "I": (500, 100)})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "One", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    builder.save(tmp_path / "one.ttf")
    return tmp_path / "one.ttf"


def relieffab(*words):
    return run([str(word) for word in words])


def test_a_figure_and_a_text_are_carved_on_one_panel(tmp_path, font, capsys):
    i, j = np.indices((100, 100)) - 49.5
    height = np.sqrt(np.maximum(45.0**2 - i**2 - j**2, 0.0)) / 45.0
    grey = np.where(i**2 + j**2 < 45**2, 2000 + 60000 * height, 0).astype(np.uint16)
    Image.fromarray(grey).save(tmp_path / "ball.png")
    small = ("--margin", "2mm", "--depth", "1mm")
    figure, word, both = tmp_path / "figure", tmp_path / "word", tmp_path / "both"
    ball = ("--size", "20x20mm", "--resolution", "80x80")
    bars = ("--text", "III", "--size", "20x10mm", "--resolution", "80x40")
    assert relieffab("relief", tmp_path / "ball.png", *ball, *small, "-o", figure) == 0
    bars += ("--wall-angle", "45deg")
    assert relieffab("relief", font, *bars, *small, "-o", word) == 0
    assert "taken for a depth" in capsys.readouterr().err
    places = (f"{figure}@2x12mm", f"{word}@2x2mm")
    assert relieffab("compose", *places, "--size", "24x34mm", "-o", both) == 0
    assert relieffab("toolpath", both, "--scallop", "0.03mm") == 0
    assert relieffab("verify", both) == 0
    report = json.loads((both / "report.json").read_text())
    assert report["verification"]["gouge_mm"] < 0.01
    kinds = [(part["model"]["kind"], part["wall_angle_deg"]) for part in report["reliefs"]]
    assert kinds == [("depth", 80), ("text", 45)]


def test_a_missing_glyph_is_said_and_nothing_written(tmp_path, font, capsys):
    assert relieffab("relief", font, "--text", "IX", "-o", tmp_path / "out") == 2
    assert "lacks glyphs" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
