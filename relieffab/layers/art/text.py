"""Text in the glyphs of a font, shaped as its script asks: joined, kerned, stacked."""

import io
import unicodedata
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.art.art import Art, Mark
from relieffab.layers.art.clip import joined
from relieffab.layers.art.curves import FINE, ring
from relieffab.layers.art.runs import Run, runs_of

Floats = NDArray[np.float64]

LINE = 1.2
"""Between lines of text, in units of the font's size."""
_NEEDED = ("head", "maxp", "hmtx", "cmap")
_OUTLINES = ("glyf", "CFF ", "CFF2")


def set_text(text: str, font: str | Path) -> Art:
    r"""Set text in a font: HarfBuzz chooses and places its glyphs; lines are centred.

    Parameters
    ----------
    text : str
        Lines parted by line ends, or by \n as it is typed; each of them reads one way.
    font : str or Path
        TrueType, OpenType, WOFF, or the first font of a collection.

    Raises
    ------
    InputError
        If the font cannot be read or lacks a glyph, the text is blank, or a line
        reads both ways.
    """
    path = Path(font)
    lines = unicodedata.normalize("NFC", text.replace("\\n", "\n")).split("\n")
    if not "".join(lines).strip():
        raise InputError("there is no text to write", expected="--text", found=repr(text))
    face = _Face(path)
    shaped = [face.line(runs_of(line)) for line in lines]
    face.check()
    marks: list[Mark] = []
    for k, (glyphs, width) in enumerate(shaped):
        found = (
            face.mark(glyph, x - width / 2, k * LINE * face.size - up) for glyph, x, up in glyphs
        )
        marks += joined([mark for mark in found if mark is not None])
    if not marks:
        raise InputError(
            "the font's glyphs for this text are blank", found=repr(text), where=str(path)
        )
    return Art(tuple(marks), None, " / ".join(line.strip() for line in lines), "text")


class _Face:
    """A font opened for shaping and for its outlines."""

    def __init__(self, path: Path) -> None:
        import uharfbuzz as hb

        self.where = str(path)
        self._face = hb.Face(_plain(path))
        self._font = hb.Font(self._face)
        self._missing: set[str] = set()
        self.size = float(self._face.upem)

    def line(self, runs: list[Run]) -> tuple[list[tuple[int, float, float]], float]:
        """Shape a line; its glyphs, where each stands on it, X and up, and its width."""
        import uharfbuzz as hb

        placed, x = [], 0.0
        for run in runs:
            buffer = hb.Buffer()
            buffer.add_str(run.text)
            buffer.language = "und"  # else it is the computer's
            buffer.guess_segment_properties()
            buffer.direction = "rtl" if run.leftward else "ltr"
            hb.shape(self._font, buffer)
            starts = sorted({info.cluster for info in buffer.glyph_infos} | {len(run.text)})
            for info, at in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True):
                if info.codepoint == 0:
                    after = starts[starts.index(info.cluster) + 1]
                    self._note(run.text[info.cluster : after])
                placed.append((info.codepoint, x + at.x_offset, float(at.y_offset)))
                x += at.x_advance
        return placed, x

    def _note(self, cluster: str) -> None:
        """Keep in mind what has no glyph, of characters that are one letter together."""
        lacking = {c for c in cluster if not self._font.get_nominal_glyph(ord(c))}
        self._missing |= lacking or {cluster[0]}

    def check(self) -> None:
        """Raise InputError if the lines shaped so far hold characters without a glyph."""
        missing = sorted(self._missing)
        if missing:
            listed = ", ".join(
                f"{c!r} (U+{ord(c):04X} {unicodedata.name(c, 'no name')})" for c in missing[:5]
            )
            raise InputError(
                "the font lacks glyphs",
                expected=f"one of its {len(self._face.unicodes)} characters",
                found=listed + (f" and {len(missing) - 5} more" if len(missing) > 5 else ""),
                where=self.where,
                hint="another font, or other words",
            )

    def mark(self, glyph: int, x: float, down: float) -> Mark | None:
        """Take a glyph's outline, its origin at X and Y."""
        rings = []
        for curves in _contours(self._font, glyph):
            shifted = [np.array([x, down]) + curve * [1.0, -1.0] for curve in curves]
            rings.append(ring(shifted, FINE * self.size, closed=True))
        whole = tuple(one for one in rings if one is not None)
        return Mark(whole, fill="nonzero") if whole else None


def _plain(path: Path) -> bytes:
    """Take a font out of its wrapping, all of it whole: HarfBuzz passes over what is not."""
    from fontTools.ttLib import TTFont, TTLibError

    whole = io.BytesIO()
    try:
        with TTFont(
            path, fontNumber=0, lazy=True, recalcBBoxes=False, recalcTimestamp=False
        ) as font:
            lacking = [tag for tag in _NEEDED if tag not in font]
            if lacking or not any(tag in font for tag in _OUTLINES):
                raise ValueError(f"no table {', '.join(lacking) or 'of outlines'}")
            font.flavor = None
            font.save(whole, reorderTables=None)
    except (
        *(TTLibError, KeyError, ImportError, OSError, ValueError, AssertionError),
        *(EOFError, zlib.error),
    ) as fault:
        raise InputError(
            "the font cannot be read",
            expected="a sound TrueType or OpenType font with outlines",
            found=f"{type(fault).__name__}: {fault}"[:200],
            where=str(path),
        ) from fault
    return whole.getvalue()


def _contours(font: Any, glyph: int) -> list[list[Floats]]:
    """Control points of the curves of each contour, as a pen was moved."""
    import uharfbuzz as hb

    out: list[list[Floats]] = []
    at = (0.0, 0.0)

    def start(x: float, y: float, _: object) -> None:
        nonlocal at
        at = (x, y)
        out.append([])

    def draw(*told: Any) -> None:
        nonlocal at
        curve = np.array([*at, *told[:-1]], float).reshape(-1, 2)  # the last is no coordinate
        out[-1].append(curve)
        at = (float(curve[-1, 0]), float(curve[-1, 1]))

    pen = hb.DrawFuncs()
    pen.set_move_to_func(start)
    pen.set_line_to_func(draw)
    pen.set_quadratic_to_func(draw)
    pen.set_cubic_to_func(draw)
    font.draw_glyph(glyph, pen)
    return [curves for curves in out if curves]
