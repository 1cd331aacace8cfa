"""Single keys from the terminal while a job runs, without waiting for them."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def keyboard() -> Iterator[Callable[[], str] | None]:
    """Give a function that returns what was typed; None where nobody sits at a terminal."""
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        yield None
    elif sys.platform == "win32":
        yield _typed_windows
    else:
        yield from _posix()


def _posix() -> Iterator[Callable[[], str]]:
    import os
    import select
    import termios
    import tty

    handle = sys.stdin.fileno()
    before = termios.tcgetattr(handle)
    tty.setcbreak(handle)

    def typed() -> str:
        ready, _, _ = select.select([handle], [], [], 0)
        return os.read(handle, 64).decode("ascii", "ignore") if ready else ""

    try:
        yield typed
    finally:
        termios.tcsetattr(handle, termios.TCSADRAIN, before)


def _typed_windows() -> str:
    import msvcrt

    keys = ""
    while msvcrt.kbhit():  # type: ignore[attr-defined]
        keys += msvcrt.getwch()  # type: ignore[attr-defined]
    return keys
