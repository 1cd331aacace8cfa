"""Text in the glyphs of a font."""

import unicodedata
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.art.art import Art, Mark
from relieffab.layers.art.curves import FINE, ring

Floats = NDArray[np.float64]

LINE = 1.2
"""Between lines of text, in units of the font's size."""


def set_text(text: str, font: str | Path) -> Art:
    r"""Set text in a font: one glyph a character, kerned by pairs, lines centred.

    Parameters
    ----------
    text : str
        Lines parted by line ends, or by \n as it is typed.
    font : str or Path
        TrueType, OpenType, WOFF, or the first font of a collection.

    Raises
    ------
    InputError
        If the font cannot be read or lacks a glyph, the text is blank, or its
        script joins or reorders its letters, which takes more than glyphs.
    """
    path = Path(font)
    lines = unicodedata.normalize("NFC", text.replace("\\n", "\n")).split("\n")
    _check_script("".join(lines))
    if not "".join(lines).strip():
        raise InputError("there is no text to write", expected="--text", found=repr(text))
    face = _Face(path)
    face.check("".join(lines))
    marks: list[Mark] = []
    for k, line in enumerate(lines):
        marks += face.line(line, k * LINE * face.size)
    if not marks:
        raise InputError(
            "the font's glyphs for this text are blank", found=repr(text), where=str(path)
        )
    return Art(tuple(marks), None, " / ".join(line.strip() for line in lines), "text")


def _check_script(text: str) -> None:
    for letter in text:
        if unicodedata.bidirectional(letter) in ("R", "AL") or unicodedata.combining(letter):
            raise InputError(
                "this script joins, stacks or reorders its letters, which is not done here",
                found=f"{letter!r} ({unicodedata.name(letter, 'no name')})",
                hint="set it in a drawing program, turn it into paths, and give the SVG",
            )


class _Face:
    """A font opened for its outlines."""

    def __init__(self, path: Path) -> None:
        from fontTools.ttLib import TTFont, TTLibError

        self.where = str(path)
        try:
            font = TTFont(path, fontNumber=0, lazy=True)
            self.size = float(font["head"].unitsPerEm)
            self.letters: dict[int, str] = font.getBestCmap() or {}
            self.glyphs = font.getGlyphSet()
            self.pairs = _kerning(font)
        except (TTLibError, KeyError, ImportError, OSError, ValueError, AssertionError) as fault:
            raise InputError(
                "the font cannot be read",
                expected="a sound TrueType or OpenType font with outlines",
                found=f"{type(fault).__name__}: {fault}"[:200],
                where=self.where,
            ) from fault

    def check(self, text: str) -> None:
        missing = sorted({c for c in text if ord(c) not in self.letters})
        if missing:
            listed = ", ".join(
                f"{c!r} (U+{ord(c):04X} {unicodedata.name(c, 'no name')})" for c in missing[:5]
            )
            raise InputError(
                "the font lacks glyphs",
                expected=f"one of its {len(self.letters)} characters",
                found=listed + (f" and {len(missing) - 5} more" if len(missing) > 5 else ""),
                where=self.where,
                hint="another font, or other words",
            )

    def line(self, text: str, down: float) -> list[Mark]:
        """Set a line, centred on X 0, its base line at Y `down`."""
        names = [self.letters[ord(c)] for c in text]
        x, starts = 0.0, []
        for name, after in zip(names, [*names[1:], ""], strict=True):
            starts.append(x)
            x += float(self.glyphs[name].width) + self.pairs.get((name, after), 0.0)
        placed = zip(names, starts, strict=True)
        marks = (self.mark(name, at - x / 2, down) for name, at in placed)
        return [mark for mark in marks if mark is not None]

    def mark(self, name: str, x: float, down: float) -> Mark | None:
        from fontTools.pens.recordingPen import DecomposingRecordingPen

        pen = DecomposingRecordingPen(self.glyphs)
        self.glyphs[name].draw(pen)
        rings = []
        for curves in _contours(pen.value):
            shifted = [np.array([x, down]) + curve * [1.0, -1.0] for curve in curves]
            rings.append(ring(shifted, FINE * self.size, closed=True))
        whole = tuple(one for one in rings if one is not None)
        return Mark(whole, fill="nonzero") if whole else None


def _contours(record: list[tuple[str, Any]]) -> list[list[Floats]]:
    """Control points of the curves of each contour, as a pen was moved."""
    out: list[list[Floats]] = []
    at = start = (0.0, 0.0)
    for what, points in record:
        if what == "moveTo":
            at = start = points[0]
            out.append([])
        elif what == "closePath":
            out[-1].append(np.array([at, start], float))
        elif what == "qCurveTo":
            for curve in _quadratics(at, points):
                out[-1].append(curve)
            at = points[-1] if points[-1] is not None else at
        elif what in ("lineTo", "curveTo"):
            out[-1].append(np.array([at, *points], float))
            at = points[-1]
    return [curves for curves in out if curves]


def _quadratics(at: Any, points: Any) -> list[Floats]:
    """Part a run of off-curve points into curves, the points between them implied."""
    from fontTools.pens.basePen import decomposeQuadraticSegment

    out = []
    for control, end in decomposeQuadraticSegment(points):
        out.append(np.array([at, control, end], float))
        at = end
    return out


def _kerning(font: Any) -> dict[tuple[str, str], float]:
    """Pairs of the old kern table, in font units; newer tables take a shaper."""
    if "kern" not in font:
        return {}
    tables = [t for t in font["kern"].kernTables if hasattr(t, "kernTable")]
    return {pair: float(by) for table in tables for pair, by in table.kernTable.items()}
