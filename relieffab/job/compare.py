"""One model by every method at several depths: all measures, and a sheet of pictures."""

import json
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.job import milling, reliefs
from relieffab.job.folder import check_folder, finished_together
from relieffab.job.report import Report, start_report
from relieffab.job.seen import look_at, read_model
from relieffab.job.settings import Chosen, Job, job_of
from relieffab.layers.model import Layers
from relieffab.layers.shading import lambert
from relieffab.picture import png8, relit
from relieffab.picture.sheet import sheet
from relieffab.picture.stone import LIGHT, unit_light
from relieffab.progress import Progress, silent
from relieffab.relief.make import make_relief
from relieffab.relief.model import Relief
from relieffab.relief.names import NAMES
from relieffab.relief.quality.measure import measure
from relieffab.relief.targets import Carving
from relieffab.relief.window import figure_size

USUAL = (2.0, 5.0, 10.0)  # percent of the figure's height
TABLE, SHEET = "compare.json", "compare.png"
BESIDE = 4  # pixels shown around the figure
FREE = 90.0  # degrees: drafted walls would make all reliefs alike where they stand

Floats = NDArray[np.float64]
Made = tuple[Relief, Report]


def percentages(text: str) -> tuple[float, ...]:
    """Read depths in percent, as "2,5,10".

    Raises
    ------
    InputError
        If they are not different numbers over 0 and at most 100.
    """
    try:
        values = tuple(float(word.strip().removesuffix("%")) for word in text.split(","))
    except ValueError:
        values = ()
    if not values or len(set(values)) < len(values) or not all(0 < v <= 100 for v in values):
        raise InputError(
            "the depths are not percentages of the figure's height",
            expected="different numbers over 0, at most 100, as 2,5,10",
            found=text,
            where="depths",
        )
    return tuple(sorted(values))


def _share(progress: Progress, before: int, count: int) -> Progress:
    """Tell of one relief's progress as of a part of all."""

    def show(stage: str, done: float, total: float, unit: str = "") -> None:  # noqa: ARG001
        progress("compare", before + done / max(total, 1.0), count)

    return show


def _every(layers: Layers, job: Job, depths: Sequence[float], progress: Progress) -> Iterator[Made]:
    """Make and measure the reliefs, a depth after the other."""
    carving, cutter = reliefs.carving_of(job), milling.cutters_of(job)[2]
    height = figure_size(layers)[0]
    ways = [(percent, name) for percent in depths for name in NAMES]
    for done, (percent, name) in enumerate(ways):
        show = _share(progress, done, len(ways))
        show("compare", 0, 1)
        start = time.perf_counter()
        way: Carving = replace(carving, depth=percent / 100 * height, method=name, wall_angle=FREE)
        relief, solution = make_relief(layers, way, progress=show)
        seconds = time.perf_counter() - start
        yield (
            relief,
            {
                "method": name,
                "percent": percent,
                "depth_mm": way.depth,
                "seconds": round(seconds, 3),
                "converged": solution and solution.converged,
                "quality": measure(relief, layers, cutter).as_dict(),
            },
        )
    progress("compare", len(ways), len(ways))


def picture(layers: Layers, made: Sequence[Made]) -> NDArray[np.uint8]:
    """Lay the reliefs out beside the model, lit alike from the upper left.

    Parameters
    ----------
    layers : Layers
    made : sequence of (Relief, row of the table)

    Returns
    -------
    (height, width) ndarray of uint8
        A row for every method, a column for every depth, the model's shading first.
    """
    rows, cols = (np.nonzero(layers.mask.any(axis=axis))[0] for axis in (1, 0))
    near = (
        slice(max(rows[0] - BESIDE, 0), rows[-1] + 1 + BESIDE),
        slice(max(cols[0] - BESIDE, 0), cols[-1] + 1 + BESIDE),
    )
    model = lambert(layers.normals[near], unit_light(LIGHT)[None])[0]
    shown = {(row["method"], row["percent"]): relit(relief)[near] for relief, row in made}
    percents = list(dict.fromkeys(row["percent"] for _, row in made))
    depths = list(dict.fromkeys(row["depth_mm"] for _, row in made))
    heads = [f"{p:g} %, {d:.2f} mm" for p, d in zip(percents, depths, strict=True)]
    cells = [[model, *(shown[name, percent] for percent in percents)] for name in NAMES]
    return sheet(cells, NAMES, ["model", *heads])


def _write(report: Report, image: NDArray[np.uint8], folder: Path) -> None:
    with finished_together(folder, (SHEET,), last=TABLE) as scratch:
        (scratch / SHEET).write_bytes(png8(image))
        text = json.dumps(report, indent=2, ensure_ascii=False, allow_nan=False)
        (scratch / TABLE).write_text(text + "\n", encoding="utf-8")


def compare(
    settings: Mapping[str, Chosen],
    folder: Path | None = None,
    *,
    depths: Sequence[float] = USUAL,
    overwrite: bool = False,
    progress: Progress = silent,
) -> Report:
    """Make a model's relief by every method, from the same layers, and measure each.

    Parameters
    ----------
    settings : mapping of Chosen
        From `relieffab.job.load.gather`; its depth, wall and method take no part.
    folder : Path, optional
        Where compare.json and compare.png go; nothing is written without it.
    depths : sequence of float
        Percent of the figure's height.
    overwrite : bool
        Write into a folder that holds files; only those two are replaced.
    progress : Progress

    Returns
    -------
    dict
        What compare.json holds; `reliefs` has a row for every method and depth.
    """
    job = job_of(settings)
    reliefs.carving_of(job)
    if folder is not None:
        check_folder(folder, overwrite=overwrite)
    model = read_model(job)
    progress("layers", 0, 1)
    seen = look_at(model, job)
    layers = seen.layers
    if layers.level:
        raise InputError(
            "there are no methods to compare: what has no depth is cut as it is",
            expected="a mesh, a depth or normal map, or a photograph",
            where=str(job.model),
        )
    progress("layers", 1, 1)
    made = list(_every(layers, job, depths, progress))
    begun = start_report(settings)
    report: Report = {
        **{key: begun[key] for key in ("schema", "version")},
        "model": seen.model,
        "view": seen.view,
        "settings": {
            k: v for k, v in begun["settings"].items() if k not in ("depth", "method", "wall_angle")
        },
        "figure_height_mm": figure_size(layers)[0],
        "cutter": milling.cutters_of(job)[2].name,
        "reliefs": [row for _, row in made],
    }
    if folder is not None:
        _write(report, picture(layers, made), folder)
    return report
