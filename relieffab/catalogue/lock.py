"""One batch at a time in a folder; and a sign by which workers anywhere see that it lasts."""

import fcntl
import os
import platform
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from relieffab.errors import InputError

LOCK = ".batch-lock"


@contextmanager
def locked(folder: Path) -> Iterator[str]:
    """Hold a folder for one batch; it is given up even by a process that dies.

    Yields
    ------
    str
        The batch's token, for `holds`.

    Raises
    ------
    InputError
        If another batch is at work in it.
    """
    path = folder / LOCK
    file = _taken(path)
    try:
        token = secrets.token_hex(8)
        file.truncate(0)
        file.write(f"{token}\nprocess {os.getpid()} on {platform.node()}\n")
        file.flush()
        yield token
    finally:
        path.unlink(missing_ok=True)
        file.close()


def _taken(path: Path) -> IO[str]:
    while True:
        file = path.open("a+", encoding="utf-8")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            who = file.read().partition("\n")[2].strip()
            file.close()
            raise InputError(
                "another batch is at work in this folder",
                found=who,
                where=str(path.parent),
                hint="wait for it, or another -o",
            ) from None
        # Whoever held it last may have removed the file that was just opened.
        if path.exists() and os.fstat(file.fileno()).st_ino == path.stat().st_ino:
            return file
        file.close()


def holds(folder: Path, token: str) -> bool:
    """Tell whether the batch of a token is at work in a folder."""
    try:
        return (folder / LOCK).read_text(encoding="utf-8").startswith(token + "\n")
    except FileNotFoundError:
        return False
