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
from relieffab.job.stocks import stock_of
from relieffab.layers.model import Stroke
from relieffab.panel.sinking import check_clear
from relieffab.progress import Progress, silent
from relieffab.relief.compose import Placed, compose, laid_out, walls_of
from relieffab.relief.model import Floats, Relief, nodes_of
from relieffab.relief.store import read_relief, to_tiff
from relieffab.relief.style.model import Marks

Place = tuple[Path, tuple[float, float]]


@dataclass(frozen=True, eq=False)
class _Part:
    """A finished folder and its place.

    `smooth` is the relief before its marks, if it has any.
    """

    folder: Path
    at: tuple[float, float]
    report: Report
    relief: Relief
    marks: tuple[Marks, ...]

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
        return Placed(relief, self.at, self.folder.name)

    def walls(self) -> Relief:
        if (self.folder / WALLS).is_file():
            return read_relief(self.folder / WALLS)
        return walls_of(self.smooth, self.wall_angle)

    def strokes(self) -> list[Stroke]:
        return [replace(s, points=s.points + self.at) for s in read_strokes(self.folder)]

    def told(self) -> Report:
        """Say what report.json holds of it."""
        return {
            "model": self.report["model"],
            "place_mm": list(self.at),
            "wall_angle_deg": self.wall_angle,
            "sha256": self.report["relief"].get("sha256"),
            "styles": [{"relief": self.folder.name, **one} for one in styles_in(self.report)],
        }


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
        Where the near left corner of each relief's own panel comes, mm.
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
    relief, marks = _composed(parts, job.size)
    sunk = nodes_of(relief.mask) | (relief.heights < 0)
    check_clear(sunk, relief.grid, stock_of(job), relief.depth)
    report = _report(settings, parts, relief)
    with finished_together(folder, ALL) as scratch:
        _write(relief, parts, job, report, scratch)
        if marks:
            styles.write_marks(marks, job, scratch)
        write_report(report, scratch)
    progress("compose", 1, 1)
    return report


def _composed(
    parts: Sequence[_Part], size: tuple[float, float]
) -> tuple[Relief, tuple[Marks, ...]]:
    """Lay the reliefs out, and the lines of their marks: one for each cutter."""
    smooth = compose([part.placed(part.smooth) for part in parts], size)
    lines: dict[Cutter, list[Floats]] = {}
    for part in parts:
        for one in part.marks:
            lines.setdefault(one.cutter, []).extend(line + part.at for line in one.lines)
    if not lines:
        return smooth, ()
    heights = laid_out([part.placed(part.relief) for part in parts], smooth.grid)
    marks = [Marks(cutter, smooth, tuple(own)) for cutter, own in lines.items()]
    return replace(smooth, heights=heights), tuple(marks)


def _walls(parts: Sequence[_Part], relief: Relief) -> Relief:
    """Give the walls of all parts, each of its own angle, as `reliefs.read_walls` reads them."""
    walls = [part.walls() for part in parts]
    edge = laid_out([p.placed(w) for p, w in zip(parts, walls, strict=True)], relief.grid)
    return replace(relief, heights=edge, depth=max(one.depth for one in walls))


def _write(relief: Relief, parts: Sequence[_Part], job: Job, report: Report, folder: Path) -> None:
    strokes = [stroke for part in parts for stroke in part.strokes()]
    looking.write_drawing(strokes, job, folder)
    report["relief"] = reliefs.relief_part(relief)
    report["relief"]["sha256"] = reliefs.write_relief(relief, folder)
    (folder / WALLS).write_bytes(to_tiff(_walls(parts, relief)))
    _, report["picture"] = pictures.write_picture(relief, None, job, folder)
