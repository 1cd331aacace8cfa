"""Whether a cutter can carve the relief."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.relief.quality.drawn import Drawn, drawn
from relieffab.relief.quality.grooves import beside, groove_depths, groove_widths
from relieffab.relief.quality.pair import Pair
from relieffab.relief.quality.use import inner_nodes
from relieffab.relief.quality.visibility import LEAST
from relieffab.relief.reach import closing

Floats = NDArray[np.float64]

TOLERANCE = 0.05  # mm left standing that no one minds


@dataclass(frozen=True)
class Carve:
    """What a cutter makes of the relief.

    Parameters
    ----------
    residual : float
        Mean height that the cutter cannot reach and leaves, over the relief's depth,
        at nodes inside the figure.
    beyond : float
        Share of those nodes where it leaves more than 0.05 mm.
    slope_inside, slope_walls : float
        99th percentile of the slope against the panel's face, degrees, away from and
        within the strip along the figure's edge and occlusions, a quarter of the depth
        and two pixels wide (`Pair.strip`).
    limit : float
        Steepest slope the cutter's flank can cut, degrees: 90 less its half angle.
    groove_fit : float
        Width of the lines' grooves at half their depth over the cutter's at that
        height: the 5th percentile along the lines, of grooves as deep as
        `visibility` asks.  1 or more fits.  NaN without grooves.
    """

    residual: float
    beyond: float
    slope_inside: float
    slope_walls: float
    limit: float
    groove_fit: float


def tip_widths(cutter: Cutter, heights: Floats) -> Floats:
    """Width of a cutter at heights above its lowest point, mm."""
    radii = np.linspace(0.0, cutter.radius, 4096)
    known = np.searchsorted(cutter.profile(radii), heights, side="right")
    return 2.0 * radii[np.maximum(known - 1, 0)]


def groove_fit(pair: Pair, cutter: Cutter, lines: Drawn) -> float:
    """Width of the narrow grooves over that of the cutter."""
    heights, pitch = pair.relief.heights, pair.relief.grid.pitch
    depth, way = groove_depths(heights, lines.points, beside(pitch))
    deep = depth >= LEAST * pair.relief.depth
    if not deep.any():
        return float("nan")
    width = groove_widths(heights, lines.points[deep], way[deep], beside(pitch)) * pitch
    return float(np.percentile(width / tip_widths(cutter, depth[deep] / 2), 5))


def carve(pair: Pair, cutter: Cutter, lines: Drawn | None = None) -> Carve:
    """See what of the relief a cutter reaches.

    Parameters
    ----------
    pair : Pair
    cutter : Cutter
        The finest that is used.
    lines : Drawn, optional
        As `drawn` finds them.
    """
    relief, mask = pair.relief, pair.layers.mask
    left = closing(relief.heights, relief.grid.pitch, cutter.profile) - relief.heights
    left = left[inner_nodes(mask)]
    steep = np.degrees(np.arctan(np.hypot(pair.slopes[0], pair.slopes[1])))
    inside = pair.from_edge > pair.strip

    def highest(values: Floats) -> float:
        return float(np.percentile(values, 99)) if values.size else float("nan")

    return Carve(
        residual=float(left.mean() / relief.depth) if left.size else float("nan"),
        beyond=float((left > TOLERANCE).mean()) if left.size else float("nan"),
        slope_inside=highest(steep[inside]),
        slope_walls=highest(steep[mask & ~inside]),
        limit=90.0 - cutter.angle / 2,
        groove_fit=groove_fit(pair, cutter, drawn(pair) if lines is None else lines),
    )
