"""The solids a relief becomes: panel, plaque or mould, whole and in parts."""

from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.job.settings import Job
from relieffab.job.stocks import round_of, stock_of
from relieffab.panel.blank import Drafting
from relieffab.panel.carve import make_panel
from relieffab.panel.draft import check_draft
from relieffab.panel.export import write_panel
from relieffab.panel.model import Panel
from relieffab.panel.mould import FLOOR, make_mould, outer_size
from relieffab.panel.plaque import make_plaque
from relieffab.panel.rounds import make_round
from relieffab.panel.tiles import split
from relieffab.panel.tongues import layout, tongue_height
from relieffab.progress import Progress, silent
from relieffab.relief.model import Floats, Relief
from relieffab.round import Curved, Round, check_depth
from relieffab.stock import Stock

Facts = dict[str, Any]


def check(job: Job) -> None:
    """Refuse a draft, a bed or a slab that gives no solid, before any work is done.

    Raises
    ------
    InputError
        If walls have no such draft, the bed is too small, or the slab too thin
        for tongues.
    """
    if (bent := round_of(job)) is not None:
        _check_round(bent, job)
        return
    if not stock_of(job).plain and (job.solid == "mould" or job.bed is not None):
        what = "has a mould" if job.solid == "mould" else "comes in parts"
        raise InputError(
            f"only a plain rectangular panel {what}",
            found="an outline, a frame or holes",
            where="solid" if job.solid == "mould" else "bed",
        )
    outer = outer_size(job.size, job.thickness, job.draft)
    size, thickness, floor = {
        "panel": (job.size, job.thickness, job.thickness - job.depth),
        "plaque": (job.size, job.thickness + job.depth, job.thickness),
        "mould": (outer, job.thickness + FLOOR, FLOOR),
    }[job.solid]
    if job.bed is not None and layout(size, job.bed, job.clearance) != (1, 1):
        tongue_height(thickness, floor, job.clearance)


def _check_round(stock: Round | Curved, job: Job) -> None:
    check_depth(stock, job.depth)
    if job.solid != "panel" or job.bed is not None:
        what = f"has a {job.solid}" if job.solid != "panel" else "comes in parts"
        raise InputError(
            f"only a flat panel {what}",
            found="a round stock or a curved board",
            where="solid" if job.solid != "panel" else "bed",
        )


def make(
    relief: Relief,
    drawn: Drafting,
    job: Job,
    progress: Progress = silent,
    *,
    walls: Floats | None = None,
) -> tuple[Panel, Facts]:
    """Make the solid that a job asks for, and what is to be said of a mould.

    Parameters
    ----------
    relief : Relief
    drawn : Drafting
        The stock.
    job : Job
    progress : Progress
    walls : (rows + 1, cols + 1) ndarray, optional
        Lowest heights that leave the relief's walls, mm, where they are not all of the
        job's angle.
    """
    tolerance = job.mesh_tolerance
    stock = drawn.stock
    if not isinstance(stock, Stock):
        return make_round(relief, stock, tolerance=tolerance, progress=progress), {}
    if job.solid == "plaque":
        own = job.wall_angle if walls is None else walls
        return make_plaque(relief, stock, walls=own, tolerance=tolerance, progress=progress), {}
    blank = drawn.blank()
    panel = make_panel(relief, stock, blank=blank, tolerance=tolerance, progress=progress)
    if job.solid == "panel":
        return panel, {}
    return make_mould(panel, job.draft), draft_facts(relief, stock, job)


def draft_facts(relief: Relief, stock: Stock, job: Job) -> Facts:
    """Say whether a cast comes free of the mould: `draft` and `findings` of report.json."""
    found = check_draft(relief, stock, job.draft)
    part: Facts = {
        "draft": {
            "asked_deg": found.asked,
            "least_deg": found.least,
            "where_mm": found.where and list(found.where),
            "share": found.share,
            "walls_share": found.walls,
        },
        "findings": [],
    }
    if found.where and not found.ok:
        x, y = found.where
        part["findings"].append(
            f"a cast will not come free: {found.share:.2%} of the relief, {found.walls:.2%} of its "
            f"walls, has less draft than {found.asked:g} degrees; the least is {found.least:.2f}, "
            f"at X {x:.2f} Y {y:.2f} (a gentler --wall-angle helps)"
        )
    return part


def write_parts(solid: Panel, job: Job, folder: Path, name: str) -> Facts:
    """Split a solid for the job's bed and write its parts as panel-A1.stl and so on.

    Parameters
    ----------
    solid : Panel
    job : Job
    folder : Path
    name : str
        Of the solid, for formats that name their object.

    Returns
    -------
    dict
        `tiles`: what each part is and where it lies, none if the solid fits the
        bed; and nothing at all where there is no bed.
    """
    if job.bed is None:
        return {}
    tiles = split(solid, job.bed, job.clearance)
    if len(tiles) == 1:
        return {"tiles": []}
    listed = []
    for tile in tiles:
        stem = f"{job.solid}-{tile.name}"
        written = _write(tile, stem, job, folder, f"{name}, part {tile.name}")
        size = tile.vertices.max(axis=0) - tile.vertices.min(axis=0)
        listed.append(
            {
                **written,
                "place_mm": list(tile.place),
                "size_mm": size.tolist(),
            }
        )
    return {"tiles": listed}


def _write(
    solid: Panel, stem: str, job: Job, folder: Path, name: str, picture: bytes | None = None
) -> Facts:
    """Write a solid, or a part of one, in the job's formats."""
    files = [f"{stem}.{kind}" for kind in job.formats]
    for file in files:
        write_panel(solid, folder / file, name=name, picture=picture)
    return {
        "file": files[0],
        "files": files,
        "triangles": len(solid.faces),
        "watertight": solid.watertight,
        "volume_mm3": solid.volume_mm3,
    }


def write_solid(
    solid: Panel, job: Job, folder: Path, *, name: str, picture: bytes | None = None
) -> Facts:
    """Write a solid in the job's formats, and in parts; what report.json holds of it.

    Parameters
    ----------
    solid : Panel
    job : Job
    folder : Path
    name : str
        Of the model, for formats that name their object.
    picture : bytes, optional
        A PNG file, for formats that carry one.
    """
    title = {"panel": "relief of", "plaque": "plaque of", "mould": "mould of"}[job.solid]
    return {
        **_write(solid, job.solid, job, folder, f"{title} {name}", picture),
        "max_error_mm": solid.max_error_mm,
        **write_parts(solid, job, folder, f"{title} {name}"),
    }
