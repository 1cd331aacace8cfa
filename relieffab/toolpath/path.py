"""Toolpath: where one cutter goes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Toolpath:
    """One cutter's motion from start to end; arrays are read-only.

    Parameters
    ----------
    name : str
        'rough', 'finish', 'lines' or 'marks'; 'marks-2' of a second cutter's.
    points : (n, 3) ndarray
        Positions of the cutter's tip, panel mm, Z0 on the face.
    feed : (n,) ndarray
        Of the move that ends at each point, mm/min; infinite for a rapid.
        The first point is reached by a rapid from wherever the machine stands.
    cutter : Cutter
    rpm : float
    """

    name: str
    points: Floats
    feed: Floats
    cutter: Cutter
    rpm: float

    def __post_init__(self) -> None:
        if self.points.ndim != 2 or self.points.shape[1:] != (3,) or len(self.points) == 0:
            raise InputError(
                "a toolpath needs points",
                expected="an array (n, 3) with n of 1 or more",
                found=f"{self.points.shape}",
            )
        if self.feed.shape != (len(self.points),):
            raise InputError(
                "a toolpath needs one feed a point",
                expected=f"{len(self.points)}",
                found=f"{self.feed.shape}",
            )
        if not np.isfinite(self.points).all() or not (self.feed > 0).all():
            raise InputError(f"the toolpath {self.name} holds NaN, infinite points or feeds of 0")
        self.points.flags.writeable = False
        self.feed.flags.writeable = False

    @property
    def lengths(self) -> Floats:
        """Length of the move that ends at each point, mm; 0 for the first."""
        steps = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        return np.concatenate([[0.0], steps])

    @property
    def cutting_length(self) -> float:
        """Length of all moves at a feed, mm."""
        return float(self.lengths[np.isfinite(self.feed)].sum())
