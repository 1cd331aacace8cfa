"""Art: filled areas and strokes as polylines, before they have a place on the panel."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Ring:
    """A polyline.

    Parameters
    ----------
    points : (n, 2) ndarray
        X to the right and Y down, as on the page.
    closed : bool
        Whether the last point joins the first.
    """

    points: Floats
    closed: bool


@dataclass(frozen=True, eq=False)
class Mark:
    """What is painted at once.

    Parameters
    ----------
    rings : tuple of Ring
    fill : {'nonzero', 'evenodd'} or None
        By which rule the inside is filled, if it is.
    paper : bool
        Whether the fill is as light as paper: it covers what lies under it.
    width : float or None
        Of its stroke, in the page's units, if it has one.
    """

    rings: tuple[Ring, ...]
    fill: str | None = None
    paper: bool = False
    width: float | None = None


@dataclass(frozen=True, eq=False)
class Art:
    """A page of marks, in the order in which they are painted.

    Parameters
    ----------
    marks : tuple of Mark
    page : tuple of float or None
        Width and height of the page, mm, where the file says them in a unit of
        length: its marks then have their own size, and X and Y are mm.
    name : str
    kind : {'svg', 'text'}
    notes : tuple of str
        What was left out.
    """

    marks: tuple[Mark, ...]
    page: tuple[float, float] | None
    name: str
    kind: str
    notes: tuple[str, ...] = ()

    @property
    def filled(self) -> bool:
        """Whether any area is to be sunk."""
        return any(mark.fill and not mark.paper for mark in self.marks)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least X and Y, largest X and Y, strokes' widths included."""
        low, high = [], []
        for mark in self.marks:
            half = (mark.width or 0.0) / 2
            for ring in mark.rings:
                low.append(ring.points.min(axis=0) - half)
                high.append(ring.points.max(axis=0) + half)
        (x0, y0), (x1, y1) = np.min(low, axis=0), np.max(high, axis=0)
        return float(x0), float(y0), float(x1), float(y1)
