"""Folders of reliefs to one folder: the reliefs of several jobs on one panel."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from relieffab.cutter import Cutter
from relieffab.job import looking, pictures, reliefs, styles
from relieffab.job.drawn import read_strokes
from relieffab.job.folder import ALL, WALLS, check_folder, finished_together
from relieffab.job.marked import styles_in
from relieffab.job.report import Report, read_report, start_report, write_report
from relieffab.job.settings import Chosen, Job, job_of, resolve
from relieffab.job.stocks import round_of, stock_of
from relieffab.layers.model import Stroke
from relieffab.panel.sinking import check_clear
from relieffab.progress import Progress, silent
from relieffab.relief.compose import compose, laid_out, walls_of
from relieffab.relief.laid import parted, parted_line
from relieffab.relief.model import Floats, Relief, nodes_of
from relieffab.relief.placed import Placed, fitted_round, scaled
from relieffab.relief.store import read_relief, to_tiff
from relieffab.relief.style.model import Marks

Place = tuple[Path, tuple[float, float]]


@dataclass(frozen=True, eq=False)
class _Part:
    """A finished folder, its place, and the scale at which it is laid there.

    `smooth` is the relief before its marks, if it has any.
    """

    folder: Path
    at: tuple[float, float]
    report: Report
    relief: Relief
    marks: tuple[Marks, ...]
    scale: float = 1.0

    @classmethod
    def read(cls, folder: Path, at: tuple[float, float]) -> "_Part":
        report, relief = read_report(folder), read_relief(folder / "relief.tiff")
        return cls(folder, at, report, relief, styles.read_marks(folder, report))

    @property
    def smooth(self) -> Relief:
        return self.marks[0].smooth if self.marks else self.relief

    @property
    def wall_angle(self) -> float:
        """Degrees; of a part that is composed itself, that of its steepest walls."""
        return job_of(resolve([("report.json", self.report["settings"])])).wall_angle

    def placed(self, relief: Relief) -> Placed:
        return Placed(scaled(relief, self.scale), self.at, self.folder.name)

    def walls(self) -> Relief:
        if (self.folder / WALLS).is_file():
            return read_relief(self.folder / WALLS)
        return walls_of(self.smooth, self.wall_angle)

    def strokes(self, around: float | None) -> list[Stroke]:
        drawn = read_strokes(self.folder)
        moved = [replace(s, points=self.scale * s.points + self.at) for s in drawn]
        return moved if around is None else [part for s in moved for part in parted(s, around)]

    def lines(self, marks: Marks, around: float | None) -> list[Floats]:
        moved = [self.scale * line + self.at for line in marks.lines]
        return moved if around is None else [p for line in moved for p in parted_line(line, around)]

    def told(self) -> Report:
        """Say what report.json holds of it."""
        return {
            "model": self.report["model"],
            "place_mm": list(self.at),
            "wall_angle_deg": self.wall_angle,
            "sha256": self.report["relief"].get("sha256"),
            "styles": [{"relief": self.folder.name, **one} for one in styles_in(self.report)],
        }


def _fitted(parts: Sequence[_Part], around: float) -> list[_Part]:
    """Have a whole number of pixels go round, with all that belongs to each part."""
    placed, scale = fitted_round([part.placed(part.relief) for part in parts], around)
    return [replace(part, at=one.at, scale=scale) for part, one in zip(parts, placed, strict=True)]


def _report(settings: Mapping[str, Chosen], parts: Sequence[_Part], relief: Relief) -> Report:
    """Begin the report: what lies where; depth and walls are the reliefs' own.

    Where one wall angle has to stand for all, it is the steepest.
    """
    texts = {name: choice.text for name, choice in settings.items() if choice.text}
    steepest = max(part.wall_angle for part in parts)
    own = {"wall_angle": f"{steepest:g}deg", "depth": f"{relief.depth:g}mm"}
    report = start_report(resolve([("relief", own), ("flag", texts)]))
    models = [part.report["model"] for part in parts]
    notes = [note for model in models for note in model.get("notes", [])]
    report["model"] = {
        "name": ", ".join(dict.fromkeys(model["name"] for model in models)),
        "notes": list(dict.fromkeys(notes)),
    }
    report["reliefs"] = [part.told() for part in parts]
    return report


def make(
    settings: Mapping[str, Chosen],
    places: Sequence[Place],
    folder: Path,
    *,
    overwrite: bool = False,
    progress: Progress = silent,
) -> Report:
    """Lay the reliefs of finished folders out on one panel.

    Parameters
    ----------
    settings : mapping of Chosen
        The panel's: size, thickness, outline, frame, holes.
    places : sequence of (folder, (X, Y))
        Where the near left corner of each relief's own panel comes, mm; on a panel that goes
        all the way round, X may be anything.
    folder : Path
        Where the files go: what `panel`, `template` and `toolpath` work on.
    overwrite : bool
    progress : Progress

    Returns
    -------
    dict
        What report.json holds.

    Raises
    ------
    InputError
        If a folder holds no relief, or the panel not all of them.
    """
    check_folder(folder, overwrite=overwrite)
    job = job_of(settings)
    progress("compose", 0, 1)
    parts = [_Part.read(path, at) for path, at in places]
    bent = round_of(job)
    around = job.size[0] if bent is not None and bent.all_round else None
    parts = parts if around is None else _fitted(parts, around)
    relief, marks = _composed(parts, job.size, around)
    sunk = nodes_of(relief.mask) | (relief.heights < 0)
    check_clear(sunk, relief.grid, stock_of(job), relief.depth)
    report = _report(settings, parts, relief)
    with finished_together(folder, ALL) as scratch:
        _write(relief, parts, job, report, scratch, around)
        if marks:
            styles.write_marks(marks, job, scratch)
        write_report(report, scratch)
    progress("compose", 1, 1)
    return report


def _composed(
    parts: Sequence[_Part], size: tuple[float, float], around: float | None
) -> tuple[Relief, tuple[Marks, ...]]:
    """Lay the reliefs out, and the lines of their marks: one for each cutter."""
    joined = around is not None
    smooth = compose([part.placed(part.smooth) for part in parts], size, joined=joined)
    lines: dict[Cutter, list[Floats]] = {}
    for part in parts:
        for one in part.marks:
            lines.setdefault(one.cutter, []).extend(part.lines(one, around))
    if not lines:
        return smooth, ()
    marked = [part.placed(part.relief) for part in parts]
    heights = laid_out(marked, smooth.grid, joined=joined)
    marks = [Marks(cutter, smooth, tuple(own)) for cutter, own in lines.items()]
    return replace(smooth, heights=heights), tuple(marks)


def _walls(parts: Sequence[_Part], relief: Relief, *, joined: bool) -> Relief:
    """Give the walls of all parts, each of its own angle, as `reliefs.read_walls` reads them."""
    walls = [part.walls() for part in parts]
    placed = [part.placed(one) for part, one in zip(parts, walls, strict=True)]
    edge = laid_out(placed, relief.grid, joined=joined)
    return replace(relief, heights=edge, depth=max(one.depth for one in walls))


def _write(
    relief: Relief,
    parts: Sequence[_Part],
    job: Job,
    report: Report,
    folder: Path,
    around: float | None,
) -> None:
    strokes = [stroke for part in parts for stroke in part.strokes(around)]
    looking.write_drawing(strokes, job, folder)
    report["relief"] = reliefs.relief_part(relief)
    report["relief"]["sha256"] = reliefs.write_relief(relief, folder)
    (folder / WALLS).write_bytes(to_tiff(_walls(parts, relief, joined=around is not None)))
    _, report["picture"] = pictures.write_picture(relief, None, job, folder)
