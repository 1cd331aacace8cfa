"""A batch from end to end: what is done is kept, what fails is told, the page shows it all."""

import shutil
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from relieffab.catalogue import rows, store
from relieffab.catalogue.engine import Engine, outcomes
from relieffab.catalogue.entries import Entry
from relieffab.catalogue.identity import finished
from relieffab.catalogue.lock import locked
from relieffab.catalogue.rows import Row
from relieffab.catalogue.task import Fault, Task
from relieffab.progress import Progress, silent

SELDOM = 5.0  # seconds between two writings of the page

Told = Callable[[Row], None]
Opened = Callable[[Sequence[Task]], AbstractContextManager[Engine]]


def batch(
    entries: Sequence[Entry],
    folder: Path,
    stage: str,
    engine: Opened,
    *,
    tell: Told = lambda _: None,
    progress: Progress = silent,
) -> dict[str, Any]:
    """Carry out jobs into one folder, a folder each, and lay out the page that shows them.

    Parameters
    ----------
    entries : sequence of Entry
    folder : Path
        The catalogue.  What was finished there by an earlier batch is kept.
    stage : str
        How far each goes, one of `relieffab.catalogue.identity.STAGES`.
    engine : callable
        Given the tasks there are to do, returns who carries them out, as a context manager.
    tell : callable
        Given the row of each job as soon as it is known.
    progress : Progress

    Returns
    -------
    dict
        What batch.json holds.

    Raises
    ------
    InputError
        If the folder cannot take the batch, or another is at work in it.
    """
    store.check_catalogue(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder) as token:
        _sweep(folder, entries)
        book = _Book(entries, folder, stage, tell, progress)
        try:
            for entry, row in _rows(entries, folder, stage, token, engine, book.heed):
                book.enter(entry, row)
        except KeyboardInterrupt as stopped:
            stopped.add_note(book.so_far())
            raise
        finally:
            _sweep(folder, entries)
            whole = book.write()
    return whole


def _rows(
    entries: Sequence[Entry],
    folder: Path,
    stage: str,
    token: str,
    engine: Opened,
    heed: Callable[[], None],
) -> Iterator[tuple[Entry, Row]]:
    """Give the row of each job: first those that fail or are done already."""
    tasks: dict[Task, Entry] = {}
    for entry in entries:
        heed()
        if entry.fault:
            yield entry, rows.row(entry, Fault(entry.fault), rows.FAILED)
            continue
        where = folder.resolve()
        task = Task(entry.name, entry.settings, stage, entry.key, where, token, entry.memory)
        report = finished(task.folder, stage, task.key, task.model)
        if report is not None:
            yield entry, rows.row(entry, report, rows.KEPT)
        else:
            tasks[task] = entry
    if not tasks:
        return
    named = {entry.name: entry for entry in tasks.values()}
    with engine(list(tasks)) as workers:
        for task, result, tries in outcomes(list(tasks), workers, heed):
            entry = named[task.name]
            yield entry, rows.row(entry, result, rows.DONE, tries)


def _sweep(folder: Path, entries: Sequence[Entry]) -> None:
    """Remove what jobs that were cut off have left half-done; each lies under its own name."""
    for entry in entries:
        for home in (folder, folder / entry.name):
            for scratch in home.glob(f".{_literal(entry.name)}-????????"):
                shutil.rmtree(scratch, ignore_errors=True)


def _literal(name: str) -> str:
    return "".join(f"[{c}]" if c in "*?[" else c for c in name)


class _Book:
    """The rows so far, and the page that is written out of them every now and then."""

    def __init__(
        self,
        entries: Sequence[Entry],
        folder: Path,
        stage: str,
        tell: Told,
        progress: Progress,
    ) -> None:
        self._rows = {entry.name: rows.waiting(entry) for entry in entries}
        self._folder, self._stage = folder, stage
        self._tell, self._progress = tell, progress
        self._begun = time.perf_counter()
        self._known = 0
        self._written = -SELDOM
        self.write()

    def heed(self) -> None:
        """Tell how far the batch is; the person may stop it there."""
        self._progress("batch", self._known, len(self._rows), "jobs")

    def enter(self, entry: Entry, row: Row) -> None:
        self._rows[entry.name] = row
        self._known += 1
        self._tell(row)
        self.heed()
        if time.perf_counter() - self._written > SELDOM:
            self.write()

    def so_far(self) -> str:
        done = sum(row["status"] in (rows.DONE, rows.KEPT) for row in self._rows.values())
        return (
            f"interrupted with {done} of {len(self._rows)} jobs done, and nothing half-written; "
            "the same command goes on from there"
        )

    def write(self) -> dict[str, Any]:
        seconds = time.perf_counter() - self._begun
        whole = store.summary(self._folder, self._stage, list(self._rows.values()), seconds)
        store.write(whole, self._folder)
        self._written = time.perf_counter()
        return whole
