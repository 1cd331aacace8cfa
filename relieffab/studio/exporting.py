"""Exporting: a job in a process of its own, told of, cancelled, whole or not at all."""

import json
import shlex
import shutil
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from relieffab.errors import InputError, RelieffabError
from relieffab.job.folder import ALL, check_folder, finished_together
from relieffab.studio.children import Children, end

JOB_FILE, MODEL = "job.toml", "model"
"""The job's own file, and the folder of its model: a model may be called panel.stl."""

PATIENCE = 10.0
"""Seconds that a cancelled job has to go."""

State = dict[str, Any]


class CancelledError(Exception):
    """The person wants no more of it."""


class BusyError(InputError):
    """One job at a time."""


class Exporter:
    """At most one job at a time.

    Parameters
    ----------
    output : Path
        Below it each job gets a folder.
    children : Children
    publish : callable
        Told of every new state.
    """

    def __init__(self, output: Path, children: Children, publish: Callable[[State], None]) -> None:
        self.output = output
        self.state: State | None = None
        self.folder: Path | None = None
        self._children = children
        self._publish = publish
        self._cancelled = threading.Event()
        self._thread: threading.Thread | None = None
        self._process: Any = None

    @property
    def running(self) -> bool:
        """Whether a job is being made."""
        return self._thread is not None and self._thread.is_alive()

    def start(self, job_file: str, model: Path, *others: Path) -> State:
        """Begin a job.

        Parameters
        ----------
        job_file : str
            Text of a job file whose model lies in `MODEL`.
        model, *others : Path
            The model's file, and those that it needs beside it.

        Raises
        ------
        BusyError
            If one is being made.
        InputError
            If there can be no folder for it.
        """
        if self.running:
            raise BusyError("a job is being made", hint="wait for it, or cancel it")
        folder = self._free(model.stem)
        check_folder(folder, overwrite=False)
        self._cancelled.clear()
        self.folder = folder
        state = self._tell({"state": "running", "stage": "start", "done": 0, "total": 1})
        self._thread = threading.Thread(
            target=self._carry_out,
            args=(job_file, (model, *others), folder),
            name="export",
            daemon=True,
        )
        self._thread.start()
        return state

    def cancel(self) -> None:
        """Stop the job, if one is being made, and wait until nothing of it is left."""
        self.give_up()
        if (process := self._process) is not None:
            end(process)
        if self._thread is not None:
            self._thread.join(timeout=PATIENCE)

    def give_up(self) -> None:
        """Take the job for cancelled, whatever ends it."""
        self._cancelled.set()

    def file(self, name: str) -> Path:
        """Find a file of the finished job.

        Raises
        ------
        InputError
            If the job has none of that name.
        """
        state = self.state
        if state and state["state"] == "done" and self.folder:
            for part in state["files"]:
                if part["name"] == name:
                    return self.folder / name
        raise InputError("the job has no such file", found=repr(name)[:80])

    def _free(self, stem: str) -> Path:
        number, folder = 1, self.output / stem
        while folder.exists():
            number += 1
            folder = self.output / f"{stem}-{number}"
        return folder

    def _tell(self, state: State) -> State:
        self.state = state
        self._publish({"export": state})
        return state

    def _carry_out(self, job_file: str, files: tuple[Path, ...], folder: Path) -> None:
        try:
            with finished_together(folder, ALL) as scratch:
                self._make(job_file, files, scratch)
        except CancelledError:
            self._tell({"state": "cancelled"})
        except RelieffabError as error:
            self._tell({"state": "failed", "error": {"message": error.message, **error.parts}})
        except OSError as error:
            where = {"where": str(error.filename)} if error.filename else {}
            fault = {"message": error.strerror or str(error), **where}
            self._tell({"state": "failed", "error": fault})
        else:
            self._tell(
                {
                    "state": "done",
                    "folder": str(folder),
                    "files": _listed(folder),
                    "command": f"relieffab make {shlex.quote(str(folder / JOB_FILE))} -o FOLDER",
                }
            )

    def _make(self, job_file: str, files: tuple[Path, ...], scratch: Path) -> None:
        (scratch / JOB_FILE).write_text(job_file, encoding="utf-8")
        (scratch / MODEL).mkdir()
        for file in files:
            shutil.copyfile(file, scratch / MODEL / file.name)
        made = scratch / "made"
        # From there, so that the report names the model as the job file does.
        self._follow([JOB_FILE, made.name], scratch)
        for path in sorted(made.iterdir()):
            path.replace(scratch / path.name)
        made.rmdir()

    def _follow(self, arguments: list[str], folder: Path) -> None:
        """Run the job and pass on what it says."""
        fault: dict[str, str] | None = None
        if self._cancelled.is_set():
            raise CancelledError
        with (
            tempfile.TemporaryFile() as errors,
            self._children.child(
                "relieffab.studio.making", arguments, folder=folder, errors=errors
            ) as process,
        ):
            self._process = process
            if self._cancelled.is_set():
                raise CancelledError
            for line in process.stdout or ():
                if not line.endswith(b"\n"):
                    break  # it was ended within a word
                told = json.loads(line)
                fault = told.get("error", fault)
                if "stage" in told:
                    self._tell({"state": "running", **told})
            status = process.wait()
            errors.seek(0)
            last = errors.read().decode(errors="replace").strip().splitlines()[-1:]
        self._process = None
        if self._cancelled.is_set():
            raise CancelledError
        if fault:
            raise InputError(fault.pop("message"), **fault)
        if status != 0:
            raise InputError("the job ended before it was done", found="".join(last)[:300])


def _listed(folder: Path) -> list[dict[str, Any]]:
    return [
        {"name": str(path.relative_to(folder)), "bytes": path.stat().st_size}
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    ]
