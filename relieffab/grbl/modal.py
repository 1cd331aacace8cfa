"""The modal state of a program: what a line inherits from those before it."""

from dataclasses import dataclass, replace
from typing import Any

MM_PER_INCH = 25.4

_GROUPS = {
    **dict.fromkeys((0.0, 1.0, 2.0, 3.0, 80.0, 38.2, 38.3, 38.4, 38.5), "motion"),
    **dict.fromkeys((17.0, 18.0, 19.0), "plane"),
    **dict.fromkeys((20.0, 21.0), "units"),
    **dict.fromkeys((90.0, 91.0), "distance"),
    **dict.fromkeys((93.0, 94.0), "feed_mode"),
    **dict.fromkeys((54.0, 55.0, 56.0, 57.0, 58.0, 59.0), "system"),
}


@dataclass(frozen=True, slots=True)
class Modal:
    """What is in force; the defaults are Grbl's own after a reset.

    Parameters
    ----------
    motion, plane, units, distance, feed_mode, system : float
        G numbers.
    feed : float
        F as last named, in the units of the program; 0 where never.
    speed : float
        S, rpm.
    spindle : int
        3, 4 or 5.
    mist, flood : bool
        M7, M8.
    """

    motion: float = 0.0
    plane: float = 17.0
    units: float = 21.0
    distance: float = 90.0
    feed_mode: float = 94.0
    system: float = 54.0
    feed: float = 0.0
    speed: float = 0.0
    spindle: int = 5
    mist: bool = False
    flood: bool = False

    @property
    def scale(self) -> float:
        """Mm of one unit of length."""
        return MM_PER_INCH if self.units == 20 else 1.0

    @property
    def relative(self) -> bool:
        """True under G91."""
        return self.distance == 91

    @property
    def quiet(self) -> bool:
        """True with spindle and coolant off."""
        return self.spindle == 5 and not (self.mist or self.flood)

    def with_g(self, code: float) -> "Modal":
        """Give the state after a G word."""
        group = _GROUPS.get(code)
        change: dict[str, Any] = {} if group is None else {group: code}
        return replace(self, **change)

    def with_m(self, code: float) -> "Modal":
        """Give the state after an M word."""
        if code in (3, 4, 5):
            return replace(self, spindle=int(code))
        if code in (7, 8):
            return replace(self, **{"mist" if code == 7 else "flood": True})
        if code == 9:
            return replace(self, mist=False, flood=False)
        if code in (2, 30):
            return Modal(motion=1.0, units=self.units, feed=self.feed, speed=self.speed)
        return self
