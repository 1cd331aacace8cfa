"""A job in a process of its own: `python -m relieffab.studio.making JOB.toml FOLDER`.

Says how it goes as JSON, a line at a time.
"""

import json
import os
import sys
import time
from pathlib import Path
from typing import Any, TextIO

from relieffab.errors import RelieffabError
from relieffab.job import run
from relieffab.job.load import gather

OFTEN = 0.1
"""Seconds between two words on the same stage."""


class _Teller:
    """Tells of progress and of the end on a stream, a JSON line each."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._stage, self._time = "", 0.0

    def tell(self, fact: dict[str, Any]) -> None:
        """Write one line."""
        self._stream.write(json.dumps(fact) + "\n")
        self._stream.flush()

    def __call__(self, stage: str, done: float, total: float, unit: str = "") -> None:
        now = time.monotonic()
        if stage == self._stage and now < self._time + OFTEN:
            return
        self._stage, self._time = stage, now
        self.tell({"stage": stage, "done": done, "total": total, "unit": unit})


def main(arguments: list[str]) -> int:
    """Do the job; nothing but its own file decides its settings."""
    job, folder = Path(arguments[0]), Path(arguments[1])
    # Whatever a library prints goes to stderr, so that only words of ours are read.
    teller = _Teller(os.fdopen(os.dup(1), "w", encoding="utf-8"))
    os.dup2(2, 1)
    try:
        run.make(gather({}, job, {}), folder, progress=teller)
    except RelieffabError as error:
        teller.tell({"error": {"message": error.message, **error.parts}})
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
