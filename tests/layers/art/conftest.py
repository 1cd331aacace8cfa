"""A small font, built by code: a box, a disc and marks, with features where asked for."""

import pytest


def build(path, *, kern=False, features="", letters=None):
    from fontTools.fontBuilder import FontBuilder
    from fontTools.pens.ttGlyphPen import TTGlyphPen

    def glyph(*rings):
        pen = TTGlyphPen(None)
        for points in rings:
            pen.moveTo(points[0])
            for point in points[1:]:
                pen.lineTo(point)
            pen.closePath()
        return pen.glyph()

    square = [(100, 0), (100, 700), (500, 700), (500, 0)]
    hole = [(200, 100), (400, 100), (400, 600), (200, 600)]
    round_ = TTGlyphPen(None)
    round_.moveTo((300, 700))
    round_.qCurveTo((600, 700), (600, 350), (600, 0), (300, 0))
    round_.qCurveTo((0, 0), (0, 350), (0, 700), (300, 700))
    round_.closePath()
    glyphs = {".notdef": glyph(), "space": glyph(), "O": glyph(square, hole), "D": round_.glyph()}
    glyphs["mark"] = glyph([(0, 0), (0, 100), (100, 100), (100, 0)])
    glyphs["tall"] = glyph([(100, 0), (100, 1400), (500, 1400), (500, 0)])
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(list(glyphs))
    letters = {" ": "space", "O": "O", "D": "D", "\U00013000": "O"} | (letters or {})
    builder.setupCharacterMap({ord(letter): name for letter, name in letters.items()})
    builder.setupGlyf(glyphs)
    builder.setupHorizontalMetrics({name: (600, 100 * (name == "O")) for name in glyphs})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Three", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    if kern:
        from fontTools.ttLib import newTable
        from fontTools.ttLib.tables._k_e_r_n import KernTable_format_0

        table = KernTable_format_0()
        table.coverage, table.version, table.kernTable = 1, 0, {("O", "D"): -150}
        builder.font["kern"] = newTable("kern")
        builder.font["kern"].version, builder.font["kern"].kernTables = 0, [table]
    if features:
        builder.addOpenTypeFeatures(features)
    builder.save(path)
    return path


@pytest.fixture
def build_font(tmp_path):
    """Return a function: features and letters to the path of a font that has them."""
    return lambda features, **letters: build(
        tmp_path / "featured.ttf", features=features, letters=letters
    )


@pytest.fixture
def font(tmp_path):
    return build(tmp_path / "three.ttf")


@pytest.fixture
def kerned(tmp_path):
    return build(tmp_path / "kerned.ttf", kern=True)
