"""A job's relief: how it is carved, solved and written."""

import hashlib
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from relieffab import profiles
from relieffab.job import styles
from relieffab.job.folder import WALLS
from relieffab.job.settings import Job
from relieffab.layers.model import Layers
from relieffab.progress import Progress, silent
from relieffab.relief.make import make_relief
from relieffab.relief.model import Floats, Relief
from relieffab.relief.png import to_png
from relieffab.relief.store import read_relief, to_tiff
from relieffab.relief.targets import Carving
from relieffab.toolpath.reach import leaves

Part = dict[str, Any]


def carving_of(job: Job) -> Carving:
    """Return how the relief is carved: nowhere narrower than the finest tip.

    It is shallower than the job's by what its marks take.
    """
    tip = profiles.cutter(job.lines)
    return Carving(
        depth=job.depth - styles.style_of(job).headroom,
        line_depth=job.line_depth,
        form_length=job.form_length,
        wall_angle=job.wall_angle,
        fillet=tip.tip_radius,
        method=job.method,
        carve=job.carve,
        line_tip=tip.profile if job.line_profile == "cutter" else None,
        reachable=partial(leaves, cutter=tip) if job.reachable == "yes" else None,
    )


def solve_relief(
    layers: Layers, job: Job, carve: str, progress: Progress = silent
) -> tuple[Relief, Part]:
    """Solve for the relief; the part is report.json's `relief`.

    Parameters
    ----------
    layers : Layers
    job : Job
    carve : str
        What is carved of what the job asks for.
    progress : Progress
    """
    carving = replace(carving_of(job), carve=carve)
    relief, solution = make_relief(layers, carving, progress=progress)
    return relief, {
        **relief_part(relief),
        "method": job.method,
        "energy": solution and solution.energy,
        "iterations": solution and solution.iterations,
        "residual": solution and solution.residual,
        "applications": solution and solution.applications,
        "converged": solution and solution.converged,
    }


def relief_part(relief: Relief) -> Part:
    """Describe a relief as report.json does."""
    return {
        "file": "relief.tiff",
        "rows": relief.heights.shape[0],
        "cols": relief.heights.shape[1],
        "pitch_mm": relief.grid.pitch,
        "origin_mm": list(relief.grid.origin),
        "depth_mm": relief.depth,
    }


def write_relief(relief: Relief, folder: Path) -> str:
    """Write relief.tiff and relief.png; return the former's SHA-256."""
    packed = to_tiff(relief)
    (folder / "relief.tiff").write_bytes(packed)
    (folder / "relief.png").write_bytes(to_png(relief))
    return hashlib.sha256(packed).hexdigest()


def read_walls(folder: Path) -> Floats | None:
    """Read the lowest heights that leave the walls of a composed panel's figures, mm.

    None where one wall angle, the job's, is that of all.
    """
    where = folder / WALLS
    return read_relief(where).heights if where.is_file() else None
