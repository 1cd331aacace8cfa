"""Vector art to Layers: what `layers.make` is for a mesh."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.art.art import Art, Mark
from relieffab.layers.art.fill import inside
from relieffab.layers.image.ink import level_layers
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.image import line_image, spread_ink
from relieffab.layers.lines.names import DRAWN
from relieffab.layers.lines.trace import simplify
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.view import check_room

Floats = NDArray[np.float64]
Matrix = list[list[float]]


def placed_on(art: Art, size: tuple[float, float], *, margin: float) -> Matrix:
    """Say where a page comes to lie: 1:1 and centred if it has a size, else as large as fits.

    Returns
    -------
    3 x 3
        Homogeneous, from the page to the panel's X and Y, mm.

    Raises
    ------
    InputError
        If the margin leaves no room, or marks at their own size lie beyond the panel.
    """
    room = check_room(size, margin)
    x0, y0, x1, y1 = art.bounds
    if art.page is not None:
        scale, middle = 1.0, (art.page[0] / 2, art.page[1] / 2)
    else:
        scale = float(min(room / np.maximum([x1 - x0, y1 - y0], 1e-12)))
        middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    x, y = size[0] / 2 - scale * middle[0], size[1] / 2 + scale * middle[1]
    left, right, top, bottom = x + scale * x0, x + scale * x1, y - scale * y0, y - scale * y1
    if min(left, bottom) < -1e-9 or right > size[0] + 1e-9 or top > size[1] + 1e-9:
        raise InputError(
            "the drawing reaches beyond the panel",
            expected=f"X 0 to {size[0]:g}, Y 0 to {size[1]:g} mm",
            found=f"X {left:.2f} to {right:.2f}, Y {bottom:.2f} to {top:.2f} mm",
            where=art.name,
            hint="a larger --size, or no unit in the SVG's width and height: it then fits itself",
        )
    return [[scale, 0.0, x], [0.0, -scale, y], [0.0, 0.0, 1.0]]


@dataclass(frozen=True, eq=False)
class ArtSight:
    """What is seen of art on the panel: filled areas are its figure, strokes its lines.

    Parameters
    ----------
    art : Art
    grid : Grid
    matrix : 3 x 3
        From `placed_on`.
    outlined : bool
        Whether fills are drawn by their outlines instead.
    inked : bool
        Whether strokes are drawn at all.
    """

    art: Art
    grid: Grid
    matrix: Matrix
    outlined: bool = False
    inked: bool = True

    @property
    def lines_only(self) -> bool:
        """Whether there is no area to sink."""
        return not self.art.filled

    @property
    def notes(self) -> tuple[str, ...]:
        """What a person should know of it, besides what the art tells itself."""
        return ()

    @property
    def facts(self) -> dict[str, Any]:
        """What report.json says of it."""
        return {"kind": self.art.kind, "marks": len(self.art.marks)}

    def _drawn(self, mark: Mark, tolerance: float) -> list[Stroke]:
        """Draw the strokes of a mark, and the outlines of its area."""
        if mark.width is None and (mark.fill is None or mark.paper):
            return []
        kind = DRAWN if mark.width is not None or self.outlined else "outline"
        if kind == DRAWN and not self.inked:
            return []
        return [
            _stroke(
                _line(ring.points, self.matrix), ring.closed or mark.width is None, tolerance, kind
            )
            for ring in mark.rings
        ]

    def strokes(self, drawing: Drawing) -> tuple[Stroke, ...]:
        """Draw it, mark by mark."""
        return tuple(
            stroke for mark in self.art.marks for stroke in self._drawn(mark, drawing.tolerance)
        )

    def layers(self, strokes: tuple[Stroke, ...], drawing: Drawing) -> Layers:
        """Put the images together; a stroke is as wide as the page says.

        Raises
        ------
        InputError
            If nothing is dark or large enough to be seen.
        """
        filled = np.zeros(self.grid.shape, bool)
        widths: dict[float, list[Stroke]] = {}
        for mark in self.art.marks:
            if mark.fill and not self.outlined:
                lines = [_line(ring.points, self.matrix) for ring in mark.rings]
                area = inside(lines, mark.fill, self.grid)
                filled = filled & ~area if mark.paper else filled | area
            drawn = [s for s in self._drawn(mark, drawing.tolerance) if s.kind == DRAWN]
            scale = self.matrix[0][0]
            width = drawing.width if mark.width is None else mark.width * scale
            widths.setdefault(width, []).extend(drawn)
        ink = np.zeros(self.grid.shape)
        for width, some in widths.items():
            ink = np.maximum(ink, line_image(some, self.grid, width=width))
        ink = spread_ink(ink, drawing.spread, self.grid)
        mask = filled if filled.any() else ink > 0
        if not mask.any():
            raise InputError(
                "nothing of the drawing is dark enough, or large enough, to be seen",
                where=self.art.name,
                hint="a finer resolution, or black fills and strokes",
            )
        return level_layers(self.grid, mask, ink, strokes)


def layers_of_art(
    art: Art,
    grid: Grid,
    matrix: Matrix,
    *,
    outlined: bool = False,
    drawing: Drawing | None = None,
) -> Layers:
    """Take the layers of art: filled areas are its figure, strokes its lines.

    Parameters
    ----------
    art : Art
    grid : Grid
    matrix : 3 x 3
        From `placed_on`.
    outlined : bool
        Whether fills are drawn by their outlines instead.
    drawing : Drawing, optional
        Its width for outlines; strokes have their own.

    Returns
    -------
    Layers
        Level; the mask is what is filled, or the ink where nothing is.
    """
    drawing = drawing or Drawing()
    sight = ArtSight(art, grid, matrix, outlined=outlined)
    return sight.layers(sight.strokes(drawing), drawing)


def _line(points: Floats, matrix: Matrix) -> Floats:
    (scale, _, x), (_, down, y), _ = matrix
    return np.stack([x + scale * points[:, 0], y + down * points[:, 1]], axis=1)


def _stroke(line: Floats, closed: bool, tolerance: float, kind: str) -> Stroke:
    kept = simplify(line, tolerance, closed=closed)
    return Stroke(kept, kind, np.ones(len(kept)), closed)
