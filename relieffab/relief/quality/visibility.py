"""Whether the lines of the drawing are seen on the relief."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.shading import lambert, light_at
from relieffab.relief.quality.drawn import Drawn, drawn
from relieffab.relief.quality.grooves import beside, groove_depths
from relieffab.relief.quality.pair import Pair, normals_of

Floats = NDArray[np.float64]

LEAST = 1 / 64  # of the relief's depth: a groove shallower than that is none
LIGHTS = np.stack([light_at(azimuth, 45.0) for azimuth in range(0, 360, 45)])


@dataclass(frozen=True)
class Visibility:
    """How the drawn lines inside the figure stand out; NaN if there are none.

    For each of eight lights 45 degrees above the panel:
    (mean off - mean on) / sqrt((var on + var off) / 2) of the lit relief's
    radiances, on the lines and on the surface beside them (`drawn.Drawn`), all
    lines together.  Positive where lines are dark; 0 where nothing varies.

    Parameters
    ----------
    median, worst : float
        Over the lights.
    grooved : float
        Share of the lines' length with a groove under it at least `least` deep, a
        sixty-fourth of the relief's depth unless given.
    """

    median: float
    worst: float
    grooved: float


def contrast(on: Floats, off: Floats) -> float:
    """How much darker some radiances are than others, in their mean deviations."""
    spread = np.sqrt((on.var() + off.var()) / 2)
    return float((off.mean() - on.mean()) / spread) if spread > 1e-9 else 0.0


def visibility(pair: Pair, lines: Drawn | None = None, *, least: float | None = None) -> Visibility:
    """Look for the drawn lines on the lit relief.

    Parameters
    ----------
    pair : Pair
    lines : Drawn, optional
        As `drawn` finds them.
    least : float, optional
        Depth from which a groove counts, mm.
    """
    lines = drawn(pair) if lines is None else lines
    least = LEAST * pair.relief.depth if least is None else least
    nothing = float("nan")
    median = worst = grooved = nothing
    if lines.on.any() and lines.off.any():
        on, off = (
            lambert(normals_of(pair.slopes[:, where])[None], LIGHTS)[:, 0]
            for where in (lines.on, lines.off)
        )
        seen = [contrast(a, b) for a, b in zip(on, off, strict=True)]
        median, worst = float(np.median(seen)), float(np.min(seen))
    if len(lines.points):
        depth, _ = groove_depths(pair.relief.heights, lines.points, beside(pair.layers.pitch))
        grooved = float((depth >= least).mean())
    return Visibility(median, worst, grooved)
