"""A drawing's ink, and its strokes."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.image.figure import border
from relieffab.layers.image.fit import Fitted, fit_on
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.vector import chains_of
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.image import spread_ink
from relieffab.layers.lines.names import DRAWN
from relieffab.layers.lines.tidy import STAIRS
from relieffab.layers.lines.trace import length, simplify, soften
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.shading import default_lights, lambert

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

BROAD = 90.0
"""Percentile of the strokes' widths that counts as full strength."""
SPUR = 1.2
"""Of the local width: shorter ends of a thinned line are no strokes but its corners."""


def ink_of(picture: Picture) -> Floats:
    """Ink, 0 to 1: what differs from the paper; nothing where it is transparent.

    Paper is what most of the border is, or most of the picture where the border is
    drawn on; the ink's tone and the paper's are the means of Otsu's two classes.

    Raises
    ------
    InputError
        If all is one tone.
    """
    from skimage.filters import threshold_otsu

    alpha = np.isfinite(picture.grey) * (1.0 if picture.alpha is None else picture.alpha)
    grey = np.nan_to_num(picture.grey)
    if (alpha < 0.5).any():
        if np.ptp(grey[alpha > 0.5]) < 0.2:  # one ink on nothing
            return np.asarray(alpha)
        grey = alpha * grey + 1.0 - alpha
    if np.ptp(grey) < 1e-3:
        raise InputError("the drawing is all of one tone", where=picture.name)
    level = threshold_otsu(grey)
    light = grey > level
    paper_light = border(light.astype(float)).mean() + light.mean() > 1.0
    tones = float(grey[light].mean()), float(grey[~light].mean())
    paper, ink = tones if paper_light else tones[::-1]
    return np.clip((grey - paper) / (ink - paper) * 1.2 - 0.1, 0.0, 1.0)


def strokes_of(ink: Floats, grid: Grid, tolerance: float) -> tuple[Stroke, ...]:
    """Follow the middle of the ink; a stroke's strength is its width against broad ones.

    Parameters
    ----------
    ink : (rows, cols) ndarray
    grid : Grid
    tolerance : float
        How far a stroke may be simplified, mm.
    """
    from skimage.morphology import skeletonize

    inked = ink > 0.5
    half = ndimage.distance_transform_edt(inked)
    middle = half[skeletonize(inked)]
    if not len(middle):
        return ()
    strength = np.clip(half / np.percentile(middle, BROAD), 0.2, 1.0)
    chains = chains_of(inked, strength, np.zeros((2, *ink.shape)), grid)
    begin, points = chains.begin, chains.points[:, :2]
    ends = points[np.concatenate([begin[:-1], begin[1:] - 1])]
    alone = np.array([(np.hypot(*(ends - end).T) < 1e-9).sum() == 1 for end in ends])
    out = []
    for k in range(len(begin) - 1):
        here = slice(begin[k], begin[k + 1])
        line = points[here]
        closed = bool(len(line) > 3 and (line[0] == line[-1]).all())
        row, col = (int(v) for v in grid.to_index(*line[len(line) // 2]))
        width = 2 * half[min(row, grid.rows - 1), min(col, grid.cols - 1)] * grid.pitch
        free = alone[k] != alone[k + len(begin) - 1]
        if free and not closed and length(line) < SPUR * width:
            continue
        table = np.column_stack([line, chains.strength[here]])
        table = soften(table[:-1] if closed else table, STAIRS, closed=closed)
        table = simplify(table, tolerance, closed=closed)
        out.append(Stroke(table[:, :2], DRAWN, np.clip(table[:, 2], 0.0, 1.0), closed))
    return tuple(sorted(out, key=lambda stroke: -length(stroke.points)))


def level_layers(grid: Grid, mask: Bools, lines: Floats, strokes: tuple[Stroke, ...]) -> Layers:
    """Layers of what has no depth of its own: lines and areas on a level face."""
    normals = np.zeros((*grid.shape, 3))
    normals[..., 2] = 1.0
    lights = default_lights()
    return Layers(
        grid=grid,
        depth=np.zeros(grid.shape),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=lines,
        strokes=strokes,
    )


@dataclass(frozen=True, eq=False)
class InkSight(Fitted):
    """What is seen of a drawing on the panel: its ink, before it is spread.

    Parameters
    ----------
    fit : Fit
        Where the picture lies on the panel.
    ink : (rows, cols) ndarray
        On the grid, 0 to 1.
    facts : dict
        As report.json says them.
    """

    ink: Floats
    facts: dict[str, Any]

    lines_only = True
    notes: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        picture: Picture,
        grid: Grid,
        size: tuple[float, float],
        margin: float,
        facts: dict[str, Any],
    ) -> "InkSight":
        """Look at a drawing."""
        ink = ink_of(picture)
        fit = fit_on(ink > 0.5, grid, size, margin=margin)
        return cls(fit, np.clip(fit.field(ink, np.ones(ink.shape, bool)), 0.0, 1.0), facts)

    def _spread(self, drawing: Drawing) -> Floats:
        return spread_ink(self.ink, drawing.spread, self.grid)

    def strokes(self, drawing: Drawing) -> tuple[Stroke, ...]:
        """Find the strokes that run through the ink."""
        return strokes_of(self._spread(drawing), self.grid, drawing.tolerance)

    def layers(self, strokes: tuple[Stroke, ...], drawing: Drawing) -> Layers:
        """Put the images together: the ink as it is."""
        lines = self._spread(drawing)
        return level_layers(self.grid, lines > 0.02, lines, strokes)
