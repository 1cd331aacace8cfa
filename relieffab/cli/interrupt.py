"""Interruption: Ctrl-C and its kin, heard even where an exception goes unheard.

A KeyboardInterrupt that is raised while a compiler's or a collector's callback runs
is printed and dropped by Python; so it is raised again at the next sign of progress.
"""

import signal
from types import FrameType

from relieffab.progress import Progress

_asked = False


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    """Leave by the way that Ctrl-C leaves: machines are stopped, scratch folders go."""
    global _asked  # noqa: PLW0603  # what a signal handler can reach
    _asked = True
    raise KeyboardInterrupt


def listen() -> None:
    """Take SIGINT, SIGTERM and SIGHUP as a wish to stop, unless told to ignore them (nohup)."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _interrupt)


def heeding(show: Progress) -> Progress:
    """Wrap a progress callback so that it raises KeyboardInterrupt once a stop was asked for."""

    def heed(stage: str, done: float, total: float, unit: str = "") -> None:
        if _asked:
            raise KeyboardInterrupt
        show(stage, done, total, unit)

    return heed
