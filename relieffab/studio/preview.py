"""Preview: layers and relief at the page's size, worked out again only where they change."""

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from relieffab.job import chain
from relieffab.job.settings import Job
from relieffab.job.stocks import stock_of
from relieffab.layers.model import Layers
from relieffab.panel.blank import Blank, drafting
from relieffab.panel.carve import make_panel
from relieffab.panel.model import Panel
from relieffab.progress import Progress
from relieffab.relief.make import make_relief
from relieffab.relief.model import Relief
from relieffab.relief.solve import Solution
from relieffab.stock import Stock
from relieffab.studio.model import Model

WIDTH = 320
"""Pixels of the longer side."""

TOLERANCE = 0.05
"""Of a panel that is only looked at, mm."""

Result = TypeVar("Result")

SEEN = (
    *("size", "margin", "frame", "view", "azimuth", "elevation", "roll", "perspective", "up"),
    *("outline", "corner", "holes", "keyholes"),
)
DRAWN = ("line_kinds", "line_width", "line_detail", "line_length", "line_spread")
SOLVED = (
    *("depth", "method", "carve", "form_length", "line_depth", "line_profile", "wall_angle"),
    *("lines", "reachable", "line_width"),
)


@dataclass(frozen=True, eq=False)
class View:
    """What is seen: layers, and how the model lies on the panel."""

    layers: Layers
    part: dict[str, Any]


@dataclass(frozen=True, eq=False)
class Solved:
    """A relief, and what it came from."""

    view: View
    relief: Relief
    solution: Solution | None


class Kept:
    """The last result of each stage, by what it depends on."""

    def __init__(self) -> None:
        self._held: dict[str, tuple[Any, Any]] = {}

    def once(self, stage: str, key: Any, make: Callable[[], Result]) -> Result:
        """Give what was made for this key, or make it."""
        held = self._held.get(stage)
        if held is None or held[0] != key:
            held = key, make()
            self._held[stage] = held
        return held[1]  # type: ignore[no-any-return]

    def last(self, stage: str) -> Any:
        """Give what a stage came to last, whatever for; None if it never did."""
        return self._held.get(stage, (None, None))[1]


def small(job: Job, width: int) -> Job:
    """Give the job at the page's size."""
    longer = max(job.size)
    pixels = tuple(max(16, round(width * side / longer)) for side in job.size)
    return replace(job, resolution=(pixels[0], pixels[1]))


class Preview:
    """Works out what the page shows, and keeps the last of each stage.

    Parameters
    ----------
    width : int
        Pixels of the longer side.
    """

    def __init__(self, width: int = WIDTH) -> None:
        self.width = width
        self.kept = Kept()
        self.seconds: dict[str, float] = {}

    def view(self, model: Model, job: Job, progress: Progress) -> View:
        """See a model."""
        key = (model, _some(job, SEEN + DRAWN))
        return self.kept.once("view", key, lambda: self._see(model, job, progress))

    def relief(self, model: Model, job: Job, progress: Progress) -> Solved:
        """Solve for the relief; from the one before, if it is the same figure's."""
        view = self.view(model, job, progress)
        progress("layers", 1, 1)
        key = (view, _some(job, SOLVED))
        return self.kept.once("relief", key, lambda: self._solve(view, job, progress))

    def panel(self, model: Model, job: Job, progress: Progress) -> Panel:
        """Carve the relief into its stock."""
        solved, stock = self.relief(model, job, progress), stock_of(job)
        blank = None if stock.plain else self.kept.once("blank", stock, lambda: _blank(stock))
        return make_panel(solved.relief, stock, blank=blank, tolerance=TOLERANCE, progress=progress)

    def _see(self, model: Model, job: Job, progress: Progress) -> View:
        start = time.perf_counter()
        progress("layers", 0, 1)
        tiny = small(job, self.width)
        looking, _ = chain.view_of(tiny, model.tried)
        layers, part = chain.make_layers(model.tried, looking, tiny)
        self.seconds["layers"] = time.perf_counter() - start
        return View(layers, part)

    def _solve(self, view: View, job: Job, progress: Progress) -> Solved:
        start = time.perf_counter()
        last: Solved | None = self.kept.last("relief")
        warm = last.solution if last and last.view is view else None
        relief, solution = make_relief(
            view.layers, chain.carving_of(job), start=warm, progress=progress
        )
        self.seconds["relief"] = time.perf_counter() - start
        return Solved(view, relief, solution)


def _blank(stock: Stock) -> Blank:
    with (
        tempfile.TemporaryDirectory(prefix="relieffab-") as folder,
        drafting(stock, Path(folder)) as work,
    ):
        return work.blank()


def _some(job: Job, names: tuple[str, ...]) -> tuple[Any, ...]:
    return tuple(getattr(job, name) for name in names)
