"""A panel in parts that fit a print bed, with tongues that find their place.

Parts meet at plane seams.  A tongue lies flat on the bed, so that it prints
without support: a prism under the neighbour's relief, tapered in plan, so that
it centres itself on its way into a notch that is wider by the clearance all
round.  Only there is a gap: the seams themselves close.
"""

from dataclasses import dataclass
from itertools import product
from string import ascii_uppercase

import manifold3d
import numpy as np

from relieffab.panel.model import Floats, Panel
from relieffab.panel.solid import checked, lowest_facing_up, manifold_of, panel_of
from relieffab.panel.tongues import (
    BEYOND,
    ROUNDING,
    SPACING,
    Pair,
    layout,
    needed,
    prism,
    tongue_height,
)


@dataclass(frozen=True, eq=False)
class Tile(Panel):
    """One part of a panel, its near left corner at X0 Y0; tongues reach beyond.

    Parameters
    ----------
    row, col : int
        From the far left corner of the panel, 0 first.
    place : tuple of float
        (X, Y) of the part's near left corner on the whole panel, mm.
    """

    row: int
    col: int
    place: Pair

    @property
    def name(self) -> str:
        """A1 for the far left part, A2 to the right of it, B1 in front of it."""
        return f"{ascii_uppercase[self.row]}{self.col + 1}"


@dataclass(frozen=True)
class _Cut:
    """How a panel is cut: its corners, the parts' counts, and the tongues."""

    low: Floats
    high: Floats
    rows: int
    cols: int
    height: float
    clearance: float

    def corner(self, row: int, col: int) -> Pair:
        """Near left corner of a part; the same number for all that share it."""
        low, high = self.low, self.high
        x = low[0] + (high[0] - low[0]) * (col / self.cols)
        y = low[1] + (high[1] - low[1]) * ((self.rows - 1 - row) / self.rows)
        return float(x), float(y)

    def _along(self, axis: int) -> Floats:
        """Middles of the tongues along a part's side, mm from its start."""
        count = (self.cols, self.rows)[axis]
        side = (self.high - self.low)[axis] / count
        most = int((side + ROUNDING) / needed(self.clearance, count, seam=True))
        tongues = max(1, min(max(2, round(side / SPACING)), most))
        return (np.arange(tongues) + 0.5) * side / tongues

    def _on_seam(
        self, at: Pair, across: bool, clearance: float | None
    ) -> list[manifold3d.Manifold]:
        up = (0.0, 0.0, float(self.low[2]))
        found = []
        for step in self._along(0 if across else 1):
            place = (at[0] + step, at[1]) if across else (at[0], at[1] + step)
            found.append(prism(place, across, self.height, clearance).translate(up))
        return found

    def region(self, row: int, col: int) -> manifold3d.Manifold:
        """Space of one part: its share of the plane, and tongues, less notches."""
        first, last = self.corner(row, col), self.corner(row - 1, col + 1)
        right, left = col < self.cols - 1, col > 0
        far, near = row > 0, row < self.rows - 1
        start = np.subtract([*first, self.low[2]], [not left, not near, BEYOND])
        end = np.add([*last, self.high[2]], [not right, not far, BEYOND])
        solids = [manifold3d.Manifold.cube(tuple(end - start)).translate(tuple(start))]
        if right:
            solids += self._on_seam((last[0], first[1]), False, None)
        if far:
            solids += self._on_seam((first[0], last[1]), True, None)
        notches = self._on_seam(first, False, self.clearance) if left else []
        notches += self._on_seam(first, True, self.clearance) if near else []
        whole = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
        return manifold3d.Manifold.batch_boolean([whole, *notches], manifold3d.OpType.Subtract)


def split(panel: Panel, bed: Pair, clearance: float = 0.2) -> tuple[Tile, ...]:
    """Split a panel into the fewest equal parts that fit a print bed.

    Parameters
    ----------
    panel : Panel
        Or another solid that stands on a level bottom: a plaque, a mould.
    bed : tuple of float
        Of the printer, X and Y, mm.
    clearance : float, optional
        Gap between tongues and notches, mm.

    Returns
    -------
    tuple of Tile
        Row by row from the far left; one if the whole panel fits.

    Raises
    ------
    InputError
        If the bed is too small or the slab too thin for tongues.
    """
    low, high = panel.vertices.min(axis=0), panel.vertices.max(axis=0)
    width, depth, thickness = (float(side) for side in high - low)
    rows, cols = layout((width, depth), bed, clearance)
    height = 0.0
    if rows * cols > 1:
        floor = lowest_facing_up(panel) - float(low[2])
        height = tongue_height(thickness, floor, clearance)
    cut = _Cut(low, high, rows, cols, height, clearance)
    whole = manifold_of(panel.vertices, panel.faces, "the panel")
    tiles = []
    for row, col in product(range(rows), range(cols)):
        part = checked(whole ^ cut.region(row, col), f"part {row + 1}, {col + 1} of the panel")
        x, y = cut.corner(row, col)
        moved = panel_of(part.translate((-x, -y, 0.0)), panel.max_error_mm)
        tiles.append(Tile(**vars(moved), row=row, col=col, place=(x, y)))
    return tuple(tiles)
