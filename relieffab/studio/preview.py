"""Preview: layers and relief at the page's size, worked out again only where they change."""

import tempfile
import time
from dataclasses import replace
from math import ceil
from pathlib import Path
from typing import Any

from relieffab.grid import Grid
from relieffab.job import looking, reliefs, seen, styles
from relieffab.job.settings import Job
from relieffab.job.stocks import round_of, stock_of
from relieffab.layers.art.make import ArtSight
from relieffab.layers.image.ink import InkSight
from relieffab.layers.image.make import Known, figure_of
from relieffab.layers.image.names import DRAWING
from relieffab.layers.image.picture import Picture
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.strokes import visible_lengths
from relieffab.layers.lines.study import Study
from relieffab.layers.make import Sight
from relieffab.layers.model import Stroke
from relieffab.layers.shading import smoothing_groups
from relieffab.panel.blank import Blank, drafting
from relieffab.panel.carve import make_panel
from relieffab.panel.model import Panel
from relieffab.panel.rounds import facing, make_round
from relieffab.progress import Progress
from relieffab.relief.make import make_relief
from relieffab.relief.solve import refitted
from relieffab.relief.style.model import mark_width
from relieffab.stock import Stock
from relieffab.studio.ask import Ask
from relieffab.studio.kept import Kept
from relieffab.studio.model import Model
from relieffab.studio.sheet import Sheet
from relieffab.studio.solved import Solved, View

WIDTH, FINE = 256, 512
"""Pixels of the longer side, while the hand moves and when it rests."""

TOLERANCE = 0.05
"""Of a panel that is only looked at, mm."""

ACROSS = 3.0
"""Pixels across a mark that is looked at."""

PLACED = (
    *("size", "margin", "view", "azimuth", "elevation", "roll", "perspective", "up"),
    *("outline", "corner", "frame", "frame_height", "frame_edge"),
    *("holes", "hole", "countersink", "keyholes", "thickness"),
)
LAID = ("image", "image_depth", "carve")
DRAWN = ("line_kinds", "line_detail", "line_length")
INKED = ("line_width", "line_spread")
SOLVED = (
    *("depth", "method", "carve", "form_length", "line_depth", "line_profile", "wall_angle"),
    *("lines", "reachable", "style", "mark_depth"),
)
MARKED = (
    *("style", "ground", "mark_spacing", "mark_depth", "mark_direction", "mark_cutter", "depth"),
    *(*PLACED, "rough", "finish", "lines"),
)
"""Settings that matter to each stage, besides those of the stages before; `LAID`, to pictures."""


def small(job: Job, width: int) -> Job:
    """Give the job at the page's size."""
    longer = max(job.size)
    pixels = tuple(max(16, round(width * side / longer)) for side in job.size)
    return replace(job, resolution=(pixels[0], pixels[1]))


def wide_enough(job: Job, width: int) -> int:
    """Give the pixels of the longer side that show the job's marks, if it has any.

    There are never more than the job itself has.
    """
    style = styles.style_of(job)
    if style.plain:
        return width
    finest = min(style.chisel.spacing, mark_width(style.tool, style.chisel.depth))
    pitch = Grid.on_panel(job.size, job.resolution).pitch
    return max(width, ceil(max(job.size) / max(finest / ACROSS, pitch)))


class Preview:
    """Works out what the page shows, and keeps the last of each stage.

    Parameters
    ----------
    width : int
        Pixels of the longer side.
    whole : bool
        Whether from the model as the page shows it, or in fewer triangles; and in
        pixels enough for the marks of a style.
    figures : Kept, optional
        Those found in pictures, whoever found them.
    """

    def __init__(
        self, width: int = WIDTH, *, whole: bool = False, figures: Kept | None = None
    ) -> None:
        self.width = width
        self.whole = whole
        self.kept = Kept()
        self.figures = figures or Kept()
        self._study: tuple[Model | None, Study | None] = None, None
        self.seconds: dict[str, float] = {}

    def _small(self, job: Job) -> Job:
        return small(job, wide_enough(job, self.width) if self.whole else self.width)

    def view(self, ask: Ask, progress: Progress) -> View:
        """See a model, and draw it."""
        start = time.perf_counter()
        model, job, tiny = ask.model, ask.job, self._small(ask.job)
        flat = isinstance(model, Sheet)
        place = model, ask.mask, tiny.resolution, _some(job, PLACED + (LAID if flat else ()))
        sight, part = self.kept.once("sight", place, lambda: self._look(ask, tiny))
        progress("layers", 1, 3)
        drawing = looking.drawing_of(tiny)
        as_inked = isinstance(sight, (InkSight, ArtSight))
        drawn = sight, _some(job, DRAWN + (INKED if as_inked else ()))
        strokes = self.kept.once("strokes", drawn, lambda: self._draw(model, sight, drawing))
        progress("layers", 2, 3)
        carve = job.carve if isinstance(sight, Sight) else seen.carve_of(sight, job)
        inked = drawn, carve, _some(job, INKED)
        view = self.kept.once(
            "view", inked, lambda: View(sight, sight.layers(strokes, drawing), part, carve)
        )
        if flat:
            seen.check_figure(view.layers, tiny)
        else:
            looking.check_figure(view.layers.mask, sight.grid, tiny)
        progress("layers", 3, 3)
        self.seconds["layers"] = time.perf_counter() - start
        return view

    def _look(self, ask: Ask, job: Job) -> tuple[Sight | seen.Sight, dict[str, Any]]:
        if isinstance(ask.model, Sheet):
            sight = seen.sight_of(ask.model.flat, job, self._known(ask.model, ask.mask, job))
            return sight, {"matrix": sight.matrix}
        mesh = ask.model.shown if self.whole else ask.model.tried
        view, _ = looking.view_of(job, mesh)
        placed = looking.place_model(mesh, view, job)
        groups = self.kept.once(
            "groups", ask.model, lambda: smoothing_groups(mesh.vertices, mesh.faces)
        )
        grid = Grid.on_panel(job.size, job.resolution)
        return Sight.of(placed, grid, groups=groups), looking.view_part(view, placed)

    def _known(self, sheet: Sheet, mask: Sheet | None, job: Job) -> Known:
        """Say what is known of a picture before it has a place: its figure takes a while."""
        kind, flat = job.image or sheet.kind, sheet.flat
        if kind == DRAWING or not isinstance(flat, Picture):
            return Known(kind)
        given = mask.flat if mask and isinstance(mask.flat, Picture) else None
        key = sheet, kind, mask
        figure = self.figures.once("figure", key, lambda: figure_of(flat, kind, given))
        return Known(sheet.kind, figure)

    def _draw(
        self, model: Model | Sheet, sight: Sight | seen.Sight, drawing: Drawing
    ) -> tuple[Stroke, ...]:
        if isinstance(model, Sheet) or not isinstance(sight, Sight):
            return sight.strokes(drawing)
        lengths = visible_lengths(drawing, sight.grid.pitch)
        whose, study = self._study
        if study is None or whose is not model or not study.serves(sight.placed, lengths):
            edges = study.edges if study and whose is model else None
            study = Study.of(sight.placed, lengths, edges=edges)
            self._study = model, study
        return sight.strokes(drawing, study=study.seen(sight.placed))

    def relief(self, view: View, job: Job, progress: Progress) -> Solved:
        """Solve for the relief of a view; from the last one, if that is of the same figure.

        It has no marks, and is shallower by what they will take.
        """
        start = time.perf_counter()
        key = view, _some(job, SOLVED)
        solved = self.kept.once("relief", key, lambda: self._solve(view, job, progress))
        self.seconds["relief"] = time.perf_counter() - start
        return solved

    def marked(self, view: View, job: Job, progress: Progress) -> Solved:
        """Solve for the relief of a view, and carve the marks of the job's style into it."""
        solved = self.relief(view, job, progress)
        if styles.style_of(job).plain:
            return solved
        start = time.perf_counter()
        progress("marks", 0, 1)
        key = solved, _some(job, MARKED)
        marked = self.kept.once("marks", key, lambda: _with_marks(solved, job))
        self.seconds["marks"] = time.perf_counter() - start
        return marked

    def panel(self, ask: Ask, progress: Progress) -> Panel:
        """Carve the relief into its stock; a round one lies with the panel's middle facing up."""
        solved = self.marked(self.view(ask, progress), ask.job, progress)
        bent, stock = round_of(ask.job), stock_of(ask.job)
        if bent is not None:
            column = make_round(solved.relief, bent, tolerance=TOLERANCE, progress=progress)
            return _as_box(facing(column, bent))
        blank = None if stock.plain else self.kept.once("blank", stock, lambda: _blank(stock))
        return make_panel(solved.relief, stock, blank=blank, tolerance=TOLERANCE, progress=progress)

    def _solve(self, view: View, job: Job, progress: Progress) -> Solved:
        carving = replace(reliefs.carving_of(job), carve=view.carve)
        last: Solved | None = self.kept.last("relief")
        start = None
        if last and last.solution and last.view.sight is view.sight:
            start = refitted(last.solution, view.layers, carving)
        relief, solution = make_relief(view.layers, carving, start=start, progress=progress)
        return Solved(view, relief, solution, carving)


def _with_marks(solved: Solved, job: Job) -> Solved:
    relief, marks = styles.carve(solved.relief, solved.view.layers, job)
    return replace(solved, relief=relief, marks=marks)


def _as_box(panel: Panel) -> Panel:
    """Move a solid so that it begins at X0 and Y0 and its highest point is at Z0, as a slab."""
    low, high = panel.vertices.min(axis=0), panel.vertices.max(axis=0)
    return replace(panel, vertices=panel.vertices - [low[0], low[1], high[2]])


def _blank(stock: Stock) -> Blank:
    with (
        tempfile.TemporaryDirectory(prefix="relieffab-") as folder,
        drafting(stock, Path(folder)) as work,
    ):
        return work.blank()


def _some(job: Job, names: tuple[str, ...]) -> tuple[Any, ...]:
    return tuple(getattr(job, name) for name in names)
