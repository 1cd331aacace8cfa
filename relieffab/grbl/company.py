"""Who takes part in a job beside the machine, and what comes of it."""

from collections.abc import Callable
from dataclasses import dataclass

from relieffab.grbl.job import Plan
from relieffab.grbl.joblog import Log
from relieffab.grbl.messages import Point
from relieffab.grbl.record import Record
from relieffab.grbl.view import View


@dataclass(frozen=True)
class SendReport:
    """A job that ended well.

    Parameters
    ----------
    lines : int
        Lines sent and acknowledged.
    cut_mm : float
        Length of G1, G2 and G3 moves, mm.
    seconds : float
        From the first line to the machine's rest, on the machine's clock.
    position : tuple of float or None
        Where the machine stands, machine coordinates, mm, A in degrees.
    firmware : str
        Version of Grbl.
    notes : tuple of str
        What the person should know.
    errors : tuple of str
        What the machine refused in check mode.
    """

    lines: int
    cut_mm: float
    seconds: float
    position: Point | None
    firmware: str
    notes: tuple[str, ...] = ()
    errors: tuple[str, ...] = ()


@dataclass(frozen=True)
class Company:
    """Who takes part in a job beside the machine; each may be left out.

    Parameters
    ----------
    show : callable
        Given a `View` whenever the machine has reported; raise from it to cancel.
    confirm : callable
        Given the `Plan` before anything moves; False leaves it at that.
    typed : callable
        Gives the keys typed since it was last called.
    keep : callable
        Given a `Record` every two seconds and at the end; None once the job is done.
    log : callable
        Given the program's digest and the time; gives the `Log` to write.
    """

    show: Callable[[View], None] | None = None
    confirm: Callable[[Plan], bool] | None = None
    typed: Callable[[], str] | None = None
    keep: Callable[[Record | None], None] | None = None
    log: Callable[[str, float], Log] | None = None
