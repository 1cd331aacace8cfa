"""A job in a process of its own: `python -m relieffab.studio.making JOB.toml FOLDER`.

Says how it goes as JSON, a line at a time.
"""

import json
import sys
import time
from pathlib import Path
from typing import Any

from relieffab.errors import RelieffabError
from relieffab.job import run
from relieffab.job.load import gather

OFTEN = 0.1
"""Seconds between two words on the same stage."""


class _Teller:
    """Progress as lines on stdout."""

    def __init__(self) -> None:
        self._last = ("", 0.0)

    def __call__(self, stage: str, done: float, total: float, unit: str = "") -> None:
        now = time.monotonic()
        if (stage, now) < (self._last[0], self._last[1] + OFTEN) and stage == self._last[0]:
            return
        self._last = stage, now
        tell({"stage": stage, "done": done, "total": total, "unit": unit})


def tell(fact: dict[str, Any]) -> None:
    """Write one line."""
    sys.stdout.write(json.dumps(fact) + "\n")
    sys.stdout.flush()


def main(arguments: list[str]) -> int:
    """Do the job; nothing but its own file decides its settings."""
    job, folder = Path(arguments[0]), Path(arguments[1])
    try:
        report = run.make(gather({}, job, {}), folder, progress=_Teller())
    except RelieffabError as error:
        tell({"error": {"message": error.message, **error.parts}})
        return error.exit_status
    tell({"report": report})
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
