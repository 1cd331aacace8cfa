"""Children: processes of the studio's own, none of which outlives it."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO


class Children:
    """The processes that run now."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._running: set[subprocess.Popen[bytes]] = set()
        self._closed = False

    @property
    def running(self) -> int:
        """How many run now."""
        return len(self._running)

    @contextlib.contextmanager
    def child(
        self,
        module: str,
        arguments: Sequence[str],
        *,
        folder: Path | None = None,
        errors: IO[bytes] | None = None,
    ) -> Iterator["subprocess.Popen[bytes]"]:
        """Run a module of ours as a process in a folder, the head of a group of its own.

        Its stdout is a pipe, and so is its stderr if no file for it is given.
        Whatever the reason for leaving, process and group are gone then.
        """
        command = [sys.executable, "-m", module, *arguments]
        with self._lock:
            if self._closed:
                raise RuntimeError("the studio ends: it starts no more processes")
            process = subprocess.Popen(
                command,
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=errors or subprocess.PIPE,
                start_new_session=True,
            )
            self._running.add(process)
        try:
            yield process
        finally:
            end(process)
            with self._lock:
                self._running.discard(process)
            for stream in (process.stdout, process.stderr):
                if stream:
                    stream.close()

    def close(self) -> None:
        """End all that run; none is started from now on."""
        with self._lock:
            self._closed = True
            running = list(self._running)
        for process in running:
            end(process)


def end(process: "subprocess.Popen[bytes]") -> None:
    """End a process and what it started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
