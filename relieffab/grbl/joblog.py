r"""The log of a job: every byte with its time, so that the job can be replayed.

    # relieffab job log 1
    # program 5f0c...               SHA-256 of the clean lines
    0.0 begin
    1.652 < Grbl 1.1h ['$' for help]\r\n
    1.652 > $I\n
    2.1 go
    9.3 key !
    9.3 > !
    60.0 cancel

The session is a pure function of what it was told and when, so the log holds all of it.
"""

from collections.abc import Callable, Iterable
from typing import TextIO

from relieffab.errors import InputError
from relieffab.grbl.job import Job
from relieffab.grbl.protocol import Session
from relieffab.grbl.stage import Failure, Fault

HEADER = "# relieffab job log 1"
FLUSH = 1.0
"""Seconds of a job that a crash of this computer may cost the log."""


class Log:
    """Write a log.

    Parameters
    ----------
    stream : TextIO
    digest : str
        The program's.
    now : float
    """

    def __init__(self, stream: TextIO, digest: str, now: float) -> None:
        self._stream = stream
        self._flushed = now
        stream.write(f"{HEADER}\n# program {digest}\n{now!r} begin\n")

    def exchange(self, received: bytes, sent: bytes, now: float) -> None:
        """Note one step of the session."""
        self._stream.write(f"{now!r} < {_escape(received)}\n")
        if sent:
            self._stream.write(f"{now!r} > {_escape(sent)}\n")
        if now - self._flushed >= FLUSH:
            self._flushed = now
            self._stream.flush()

    def event(self, name: str, now: float, data: bytes = b"") -> None:
        """Note what else happened: go, key, cancel, reconnected."""
        self._stream.write(f"{now!r} {name} {_escape(data)}".rstrip(" ") + "\n")

    def flush(self) -> None:
        """Bring all of it to the disk."""
        self._stream.flush()


def _escape(data: bytes) -> str:
    return data.decode("latin-1").encode("unicode_escape").decode("ascii")


def _unescape(text: str) -> bytes:
    return text.encode("ascii").decode("unicode_escape").encode("latin-1")


def replay(lines: Iterable[str], job: Job) -> Session:
    """Let a session live through a log again.

    Parameters
    ----------
    lines : iterable of str
        The log.
    job : Job
        The same program, asked for in the same way.

    Returns
    -------
    Session
        As it was at the end of the log.

    Raises
    ------
    InputError
        If the log is of another program, or the session acts otherwise than logged.
    """
    session: Session | None = None
    out, expected = b"", b""
    for number, line in enumerate(lines, start=1):
        if line.startswith("#"):
            if line.startswith("# program ") and line.split()[2] != job.program.digest:
                raise InputError("the log is of another program", where=f"line {number}")
            continue
        time, name, data = (*line.rstrip("\n").split(" ", 2), "")[:3]
        now = float(time)
        if name == "begin":
            session = Session(job, now=now)
        elif session is None:
            raise InputError("this is no log of a job", expected="begin", where=f"line {number}")
        elif name == "<":
            _compare(out, expected, number)
            out, expected = session.advance(_unescape(data), now), b""
        elif name == ">":
            expected = _unescape(data)
        else:
            _events(session)[name](_unescape(data), now)
    _compare(out, expected, 0)
    if session is None:
        raise InputError("this is no log of a job", expected=HEADER)
    return session


def _events(session: Session) -> dict[str, Callable[[bytes, float], None]]:
    lost = Failure(Fault.UNPLUGGED, "the connection to the machine was lost")
    return {
        "go": lambda _, now: session.go(now),
        "key": lambda data, _: session.command(data),
        "cancel": lambda _, now: session.cancel(now),
        "reconnected": lambda _, now: session.reconnected(lost, now),
    }


def _compare(out: bytes, expected: bytes, number: int) -> None:
    if out != expected:
        raise InputError(
            "the replay differs from the log",
            expected=ascii(expected),
            found=ascii(out),
            where=f"before line {number}" if number else "at the end",
        )
