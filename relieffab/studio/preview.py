"""Preview: layers and relief at the page's size, worked out again only where they change."""

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from relieffab.grid import Grid
from relieffab.job import looking, reliefs
from relieffab.job.settings import Job
from relieffab.job.stocks import stock_of
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.strokes import visible_lengths
from relieffab.layers.lines.study import Study
from relieffab.layers.make import Sight
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.shading import smoothing_groups
from relieffab.panel.blank import Blank, drafting
from relieffab.panel.carve import make_panel
from relieffab.panel.model import Panel
from relieffab.progress import Progress
from relieffab.relief.make import make_relief
from relieffab.relief.model import Relief
from relieffab.relief.solve import Solution, refitted
from relieffab.relief.targets import Carving
from relieffab.stock import Stock
from relieffab.studio.model import Model

WIDTH, FINE = 256, 512
"""Pixels of the longer side, while the hand moves and when it rests."""

TOLERANCE = 0.05
"""Of a panel that is only looked at, mm."""

Result = TypeVar("Result")

PLACED = (
    *("size", "margin", "view", "azimuth", "elevation", "roll", "perspective", "up"),
    *("outline", "corner", "frame", "frame_height", "frame_edge"),
    *("holes", "hole", "countersink", "keyholes", "thickness"),
)
DRAWN = ("line_kinds", "line_detail", "line_length")
INKED = ("line_width", "line_spread")
SOLVED = (
    *("depth", "method", "carve", "form_length", "line_depth", "line_profile", "wall_angle"),
    *("lines", "reachable"),
)
"""Settings that matter to each stage, besides those of the stages before."""


@dataclass(frozen=True, eq=False)
class View:
    """What is seen of a model.

    Parameters
    ----------
    sight : Sight
    layers : Layers
    part : dict
        What report.json holds of it.
    """

    sight: Sight
    layers: Layers
    part: dict[str, Any]


@dataclass(frozen=True, eq=False)
class Solved:
    """A relief, and what it came from.

    Parameters
    ----------
    view : View
    relief : Relief
    solution : Solution or None
        None where a classic method made it.
    carving : Carving
    """

    view: View
    relief: Relief
    solution: Solution | None
    carving: Carving


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
    whole : bool
        Whether from the model as the page shows it, or in fewer triangles.
    """

    def __init__(self, width: int = WIDTH, *, whole: bool = False) -> None:
        self.width = width
        self.whole = whole
        self.kept = Kept()
        self._study: tuple[Model | None, Study | None] = None, None
        self.seconds: dict[str, float] = {}

    def view(self, model: Model, job: Job, progress: Progress) -> View:
        """See a model, and draw it."""
        start = time.perf_counter()
        tiny = small(job, self.width)
        place = model, _some(job, PLACED)
        sight, part = self.kept.once("sight", place, lambda: self._look(model, tiny))
        progress("layers", 1, 3)
        drawing = looking.drawing_of(tiny)
        drawn = sight, _some(job, DRAWN)
        strokes = self.kept.once("strokes", drawn, lambda: self._draw(model, sight, drawing))
        progress("layers", 2, 3)
        inked = drawn, _some(job, INKED)
        view = self.kept.once(
            "view", inked, lambda: View(sight, sight.layers(strokes, drawing), part)
        )
        looking.check_figure(view.layers.mask, sight.grid, tiny)
        progress("layers", 3, 3)
        self.seconds["layers"] = time.perf_counter() - start
        return view

    def _look(self, model: Model, job: Job) -> tuple[Sight, dict[str, Any]]:
        mesh = model.shown if self.whole else model.tried
        view, _ = looking.view_of(job, mesh)
        placed = looking.place_model(mesh, view, job)
        groups = self.kept.once(
            "groups", model, lambda: smoothing_groups(mesh.vertices, mesh.faces)
        )
        grid = Grid.on_panel(job.size, job.resolution)
        return Sight.of(placed, grid, groups=groups), looking.view_part(view, placed)

    def _draw(self, model: Model, sight: Sight, drawing: Drawing) -> tuple[Stroke, ...]:
        lengths = visible_lengths(drawing, sight.grid.pitch)
        whose, study = self._study
        if study is None or whose is not model or not study.serves(sight.placed, lengths):
            edges = study.edges if study and whose is model else None
            study = Study.of(sight.placed, lengths, edges=edges)
            self._study = model, study
        return sight.strokes(drawing, study=study.seen(sight.placed))

    def relief(self, view: View, job: Job, progress: Progress) -> Solved:
        """Solve for the relief of a view; from the last one, if that is of the same figure."""
        start = time.perf_counter()
        key = view, _some(job, SOLVED)
        solved = self.kept.once("relief", key, lambda: self._solve(view, job, progress))
        self.seconds["relief"] = time.perf_counter() - start
        return solved

    def panel(self, model: Model, job: Job, progress: Progress) -> Panel:
        """Carve the relief into its stock."""
        solved = self.relief(self.view(model, job, progress), job, progress)
        stock = stock_of(job)
        blank = None if stock.plain else self.kept.once("blank", stock, lambda: _blank(stock))
        return make_panel(solved.relief, stock, blank=blank, tolerance=TOLERANCE, progress=progress)

    def _solve(self, view: View, job: Job, progress: Progress) -> Solved:
        carving = reliefs.carving_of(job)
        last: Solved | None = self.kept.last("relief")
        start = None
        if last and last.solution and last.view.sight is view.sight:
            start = refitted(last.solution, view.layers, carving)
        relief, solution = make_relief(view.layers, carving, start=start, progress=progress)
        return Solved(view, relief, solution, carving)


def _blank(stock: Stock) -> Blank:
    with (
        tempfile.TemporaryDirectory(prefix="relieffab-") as folder,
        drafting(stock, Path(folder)) as work,
    ):
        return work.blank()


def _some(job: Job, names: tuple[str, ...]) -> tuple[Any, ...]:
    return tuple(getattr(job, name) for name in names)
