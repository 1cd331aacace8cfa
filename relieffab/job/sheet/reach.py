"""How far a cutter has to stand out of its collet."""

from collections.abc import Mapping
from math import ceil
from typing import Any, NamedTuple

CLEAR = 3.0  # mm between the collet's nut and the highest part of the stock


class Reach(NamedTuple):
    """How far out of its collet a cutter has to be, mm.

    Parameters
    ----------
    deep : float
        How far under the face its tip goes.
    least : float
        What must stand out of the collet: that, what rises over the face, and 3 mm for the
        nut; never less than the flutes, which the collet must not hold.
    known : float
        What its profile says stands out; 0 where it says nothing.
    """

    deep: float
    least: float
    known: float

    @property
    def short(self) -> bool:
        """Whether the profile's is not enough."""
        return 0 < self.known < self.least


def reach_of(part: Mapping[str, Any], slab: Mapping[str, Any]) -> Reach:
    """Tell a program's cutter's reach.

    Parameters
    ----------
    part : mapping
        One of report.json's `programs`.
    slab : mapping
        Its `slab`.
    """
    cutter, frame = part["cutter"], slab.get("frame")
    deep = max(0.0, -(part["bounds_mm"][0][2] + slab["work_zero"][2]))
    top = max(frame["height"], 0.0) if frame else 0.0
    least = max(deep + top + CLEAR, cutter["flute_length"])
    return Reach(deep, float(ceil(least - 1e-9)), cutter.get("stickout", 0.0))
