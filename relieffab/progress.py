"""How long work tells of itself: one plain callback, so that no stage knows a console."""

from typing import Protocol


class Progress(Protocol):
    """Called as work goes on; raise from it to cancel."""

    def __call__(self, stage: str, done: float, total: float, unit: str = "") -> None:
        """Say that `done` of `total` (in `unit`) of `stage` lies behind."""


def silent(stage: str, done: float, total: float, unit: str = "") -> None:
    """Say nothing: the default of every function that takes a `Progress`."""
