"""Interruption: Ctrl-C and its kin, heard even where an exception must not be raised.

The compiler calls back into Python: an exception raised there is printed and dropped,
or brings the process down.  So while it runs nothing is raised; what was asked for is
remembered, and raised at the next sign of progress.
"""

import signal
from types import FrameType

from relieffab.progress import Progress

_asked = False


def _compiling(frame: FrameType | None) -> bool:
    """Tell whether a frame, or one that called it, is the compiler's."""
    while frame is not None:
        if str(frame.f_globals.get("__name__")).partition(".")[0] in ("numba", "llvmlite"):
            return True
        frame = frame.f_back
    return False


def _interrupt(_number: int, frame: FrameType | None) -> None:
    """Leave by the way that Ctrl-C leaves: machines are stopped, scratch folders go."""
    global _asked  # noqa: PLW0603  # what a signal handler can reach
    _asked = True
    if not _compiling(frame):
        raise KeyboardInterrupt


def listen() -> None:
    """Take SIGINT, SIGTERM and SIGHUP as a wish to stop, unless told to ignore them (nohup)."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _interrupt)


def raise_if_asked() -> None:
    """Raise KeyboardInterrupt once a stop was asked for."""
    if _asked:
        raise KeyboardInterrupt


def heeding(show: Progress) -> Progress:
    """Wrap a progress callback so that it raises KeyboardInterrupt once a stop was asked for."""

    def heed(stage: str, done: float, total: float, unit: str = "") -> None:
        raise_if_asked()
        show(stage, done, total, unit)

    return heed
