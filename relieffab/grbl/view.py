"""What a person sees of a job while it runs."""

from dataclasses import dataclass

from relieffab.grbl.messages import Point


@dataclass(frozen=True)
class View:
    """One moment.

    Parameters
    ----------
    state : str
        What the machine does, by Grbl's name.
    meaning : str
        What that means where a person has to know; else empty.
    cut_mm, total_mm : float
        Length cut, and of the whole program.
    left_s : float or None
        Seconds to the end.
    position : tuple of float or None
        Work coordinates, mm, A in degrees.
    feed, speed : float
        mm/min and rpm, as reported.
    overrides : tuple of 3 int
        Feed, rapids, spindle, percent.
    fill : float
        Share of the receive buffer that is spoken for.
    line : int
        Of the source, at which the machine was last seen.
    """

    state: str
    meaning: str
    cut_mm: float
    total_mm: float
    left_s: float | None
    position: Point | None
    feed: float
    speed: float
    overrides: tuple[int, int, int]
    fill: float
    line: int
