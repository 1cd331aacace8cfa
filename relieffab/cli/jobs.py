"""What is kept of jobs on this computer: the log of each, and how far it came."""

import json
import os
import shutil
import time
from pathlib import Path

import platformdirs

from relieffab.errors import InputError
from relieffab.grbl.program import Program
from relieffab.grbl.record import RUNNING, Record, from_dict

LOG_PER_LINE = 120
"""Bytes that a line of a program takes in a log, about."""
SELDOM = 1.0
"""Seconds between two records of a job that runs."""
SPARE = 20 << 20
"""Bytes for status reports, and for everything else on the disk."""


class Kept:
    """The log and the record of one program.

    Parameters
    ----------
    program : Program
    log : Path or None
        Where the log goes if not with the record.
    """

    def __init__(self, program: Program, log: Path | None = None) -> None:
        folder = Path(platformdirs.user_state_dir("relieffab")) / "jobs"
        folder.mkdir(parents=True, exist_ok=True)
        self._record = folder / f"{program.digest[:16]}.json"
        self._kept = -SELDOM
        self.log = log or self._record.with_suffix(".log")
        need = len(program) * LOG_PER_LINE + SPARE
        for place in {folder, self.log.parent}:
            free = shutil.disk_usage(place).free
            if free < need:
                raise InputError(
                    "the disk has no room for the log of this job",
                    expected=f"{need / 1e6:.0f} MB",
                    found=f"{free / 1e6:.0f} MB",
                    where=str(place),
                    hint="free some space, or name another place with --log",
                )

    def read(self) -> Record | None:
        """Give what was kept; None where the job never began or was done."""
        if not self._record.is_file():
            return None
        try:
            return from_dict(json.loads(self._record.read_text(encoding="utf-8")))
        except (json.JSONDecodeError, InputError) as error:
            raise InputError(
                f"the record of the job cannot be read: {error}", where=str(self._record)
            ) from error

    def keep(self, record: Record | None) -> None:
        """Keep a record in place of the last one; None: the job is done."""
        if record is None:
            self._record.unlink(missing_ok=True)
            return
        now = time.monotonic()
        if record.reason == RUNNING and now - self._kept < SELDOM:
            return  # a simulated machine may run a thousand times as fast as the disk
        self._kept = now
        beside = self._record.with_suffix(".part")
        with beside.open("w", encoding="utf-8") as file:
            json.dump(record.to_dict(), file)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(self._record)
