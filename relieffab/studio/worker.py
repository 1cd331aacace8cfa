"""Worker: the one thread that works things out, the newest ask first."""

import contextlib
import threading
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from dataclasses import dataclass, field
from typing import Any

from relieffab.progress import Progress, silent

KINDS = ("carved", "preview", "panel", "toolpaths", "warm")
"""What may be asked for, the most urgent first."""

PATIENCE = 5.0
"""Seconds that the thread is waited for at the end."""

Work = Callable[[Progress], Any]


class SupersededError(Exception):
    """A newer ask has come: nobody waits for this one."""


@dataclass(eq=False)
class _Ask:
    kind: str
    work: Work
    report: Progress
    future: "Future[Any]" = field(default_factory=Future)
    dropped: bool = False


class Worker:
    """One thread with one place a kind: an ask takes the place of an older one of its kind.

    There is one because compiled kernels use all cores by themselves, and not every
    threading layer of Numba bears two callers.
    """

    def __init__(self) -> None:
        self._change = threading.Condition()
        self._waiting: dict[str, _Ask] = {}
        self._current: _Ask | None = None
        self._closed = False
        self._thread = threading.Thread(target=self._run, name="studio", daemon=True)
        self._thread.start()

    def ask(
        self, kind: str, work: Work, *, drops: tuple[str, ...] = (), report: Progress = silent
    ) -> "Future[Any]":
        """Have something worked out.

        Parameters
        ----------
        kind : str
            One of `KINDS`.
        work : callable
            Takes a `Progress` and is to call it often: it is cancelled from there.
        drops : tuple of str
            Other kinds that are void with this ask.
        report : Progress
            Told of what the work tells.

        Returns
        -------
        Future
            Raises `SupersededError` where a newer ask has come.
        """
        ask = _Ask(kind, work, report)
        with self._change:
            if self._closed:
                _superseded(ask)
                return ask.future
            self._drop((kind, *drops))
            self._waiting[kind] = ask
            self._change.notify()
        return ask.future

    def _drop(self, kinds: tuple[str, ...]) -> None:
        for kind in kinds:
            if waiting := self._waiting.pop(kind, None):
                _superseded(waiting)
        if self._current and self._current.kind in kinds:
            self._current.dropped = True

    def stop(self) -> None:
        """Drop everything, and take no more."""
        with self._change:
            self._closed = True
            self._drop(KINDS)
            self._change.notify()

    def close(self) -> None:
        """Stop, and wait for the thread to come to its next word of progress."""
        self.stop()
        self._thread.join(timeout=PATIENCE)

    def _run(self) -> None:
        while True:
            with self._change:
                self._current = None
                self._change.wait_for(lambda: self._waiting or self._closed)
                if self._closed:
                    return
                ask = self._waiting.pop(min(self._waiting, key=KINDS.index))
                self._current = ask
            _carry_out(ask)


def _superseded(ask: _Ask) -> None:
    # Whoever asked may have gone, at any moment.
    with contextlib.suppress(InvalidStateError):
        ask.future.set_exception(SupersededError())


def _carry_out(ask: _Ask) -> None:
    def heed(stage: str, done: float, total: float, unit: str = "") -> None:
        if ask.dropped or ask.future.cancelled():
            raise SupersededError
        ask.report(stage, done, total, unit)

    try:
        result = ask.work(heed)
        heed(ask.kind, 1, 1)
    except BaseException as fault:  # noqa: BLE001  # it belongs to whoever asked
        with contextlib.suppress(InvalidStateError):
            ask.future.set_exception(fault)
    else:
        with contextlib.suppress(InvalidStateError):
            ask.future.set_result(result)
