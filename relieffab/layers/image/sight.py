"""What is seen of a picture on the panel, before and after it is drawn."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.image.edges import draw
from relieffab.layers.image.fit import Fitted
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.image import line_image, spread_ink
from relieffab.layers.model import Layers, Stroke

Floats = NDArray[np.float64]
Facts = dict[str, Any]

DOUBTFUL = 0.75
"""Likeness of a depth map to its normals under which a person is told."""
LOST = 0.2
"""Share of a figure's outline that is faint, from which a person is told."""


@dataclass(frozen=True, eq=False)
class PictureSight(Fitted):
    """What is seen of a picture on the panel, before it is drawn.

    Parameters
    ----------
    fit : Fit
        Where the picture lies on the panel.
    bare : Layers
        All but the lines.
    facts : dict
        As report.json says them.
    grey : (rows, cols) ndarray or None
        A photograph's brightness.
    """

    bare: Layers
    facts: Facts
    grey: Floats | None = None

    @property
    def lines_only(self) -> bool:
        """Whether there is no form to carve."""
        return self.bare.level

    @property
    def notes(self) -> tuple[str, ...]:
        """What a person should know of it, besides what was `told`."""
        found = []
        bands = self.facts.get("banding")
        if bands:
            found.append(
                f"{bands['levels']} levels of {bands['step_mm']:.3f} mm smoothed within half a step"
            )
        hidden = self.facts.get("hidden_edges_mm", 0.0)
        if hidden > 0:
            found.append(
                f"{hidden:.0f} mm of edges behind which the figure may hide part of itself: how "
                "deep the step is there is a guess, for no normal tells; --depth-map would"
            )
        beside = self.facts.get("depth_map")
        if beside and beside["alike"] < DOUBTFUL:
            found.append(
                f"the depth map's slopes are like the normals' by {beside['alike']:.2f} of 1 only: "
                "it is noisy, or its greys are not even with depth"
            )
        faint = self.facts.get("faint_outline", 0.0)
        if faint > LOST:
            found.append(
                f"the figure hardly stands out along {faint:.0%} of its outline, which may be "
                "wrong there: look at the relief, or say it by --mask"
            )
        if self.facts.get("light_fit", 1.0) < 0.3:
            found.append("its shading does not tell its form well: look at the relief")
        return tuple(found)

    def strokes(self, drawing: Drawing) -> tuple[Stroke, ...]:
        """Draw it."""
        return draw(self.bare, drawing, self.grey)

    def layers(self, strokes: tuple[Stroke, ...], drawing: Drawing) -> Layers:
        """Put the images together, the strokes as ink."""
        dark = [stroke for stroke in strokes if not stroke.light]
        ink = line_image(dark, self.grid, width=drawing.width)
        lines = spread_ink(ink, drawing.spread, self.grid)
        return replace(self.bare, lines=lines, strokes=strokes)
