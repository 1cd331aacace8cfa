"""The stages of a job, each writing its files into a folder and saying what they are."""

import hashlib
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.fittings import PLACES
from relieffab.gcode.setup import Setup
from relieffab.gcode.write import check_change
from relieffab.grid import Grid
from relieffab.job import solids, styles
from relieffab.job.settings import Job
from relieffab.job.stocks import machine_of, milled_of, round_of, stock_of
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.svg import strokes_to_svg
from relieffab.layers.make import layers_of
from relieffab.layers.mesh import Mesh
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.shading import light_at
from relieffab.layers.view import VIEWS, Placed, View, guess_up, place
from relieffab.panel import export
from relieffab.panel.model import Panel
from relieffab.panel.sinking import check_clear
from relieffab.picture import (
    panel_picture,
    png8,
    png16,
    smaller,
    solid_picture,
    standing_picture,
)
from relieffab.progress import Progress, silent
from relieffab.relief.laid import laid, laid_marks, laid_strokes
from relieffab.relief.make import make_relief
from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.png import to_png
from relieffab.relief.store import to_tiff
from relieffab.relief.style.model import Marks
from relieffab.relief.targets import Carving
from relieffab.round import Curved, Round
from relieffab.toolpath.check import check_stepover, check_tools
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.plan import plan
from relieffab.toolpath.positions import Position, positions
from relieffab.toolpath.reach import leaves
from relieffab.toolpath.settings import Milling, Settings

Part = dict[str, Any]
Planned = tuple[Position | None, tuple[Toolpath, ...]]
"""What is cut at a position; at None where the stock stays where it is."""

SCARAB_UP = "y"  # of the model carved where no file is named
THUMBNAIL = 512  # pixels wide


def cutters_of(job: Job) -> tuple[Cutter, Cutter, Cutter]:
    """Return the cutters of roughing, finishing and lines."""
    return profiles.cutter(job.rough), profiles.cutter(job.finish), profiles.cutter(job.lines)


def all_cutters_of(job: Job) -> tuple[Cutter, ...]:
    """Return the cutters of all programs, that of the marks too."""
    style = styles.style_of(job)
    return cutters_of(job) if style.plain else (*cutters_of(job), style.tool)


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


def setup_of(job: Job, depth: float) -> Setup:
    """Return what the programs of a relief are written for, and judged by."""
    machine, material = machine_of(job), profiles.material(job.material)
    return Setup(machine, material, milled_of(job), depth, job.units)


def positions_of(job: Job) -> tuple[Position | None, ...]:
    """Return how the stock lies, time after time; (None,) where it need not be moved."""
    if job.positions is None:
        return (None,)
    if round_of(job) is not None:
        raise InputError("only a flat panel is cut at several positions", where="positions")
    found = positions(
        stock_of(job),
        machine_of(job),
        all_cutters_of(job),
        job.positions,
        overlap=job.overlap,
        zero=PLACES[job.work_zero],
    )
    return found or (None,)


def cut_settings(job: Job) -> Settings:
    """Return how finely a job is cut, and which way round."""
    angle, crossed = job.rows
    milling = cast(Milling, job.milling)
    return Settings(job.stepover, job.scallop, angle=angle, crossed=crossed, milling=milling)


def check(job: Job) -> None:
    """Refuse what can be seen to fail before any work is done.

    Raises
    ------
    InputError
        If a profile is unknown, or machine, cutters, stock and depth do not fit.
    """
    styles.check(job)
    carving_of(job)
    solids.check(job)
    cutters = all_cutters_of(job)
    setup = setup_of(job, job.depth)
    check_change(len(cutters) if job.cutter_change == "pause" else 1, setup)
    for position in positions_of(job):
        check_tools(setup.machine, cutters, setup.stock, job.depth, position)
    cut_settings(job)
    if job.stepover is not None:
        check_stepover(job.stepover, cutters[1])


def view_of(job: Job, mesh: Mesh) -> tuple[View, str]:
    """Return the view a job asks for, and a note where the up axis had to be guessed."""
    guessed = job.up is None and job.model is not None
    up = guess_up(mesh) if guessed else job.up or SCARAB_UP
    azimuth, elevation = VIEWS[job.view]
    view = View(
        azimuth if job.azimuth is None else job.azimuth,
        elevation if job.elevation is None else job.elevation,
        job.roll,
        up,
        job.perspective,
    )
    return view, f"up axis guessed: {up} (say --up to choose)" if guessed else ""


def model_part(mesh: Mesh, sha256: str | None) -> Part:
    """Describe a mesh as report.json does."""
    return {
        "name": mesh.name,
        "kind": "mesh",
        "vertices": len(mesh.vertices),
        "triangles": len(mesh.faces),
        "notes": list(mesh.notes),
        "sha256": sha256,
    }


def margin_of(job: Job) -> float:
    """Return how far a job's figure stays from the panel's sides, its frame included, mm."""
    frame = stock_of(job).frame
    return job.margin + (frame.width if frame else 0.0)


def place_model(mesh: Mesh, view: View, job: Job) -> Placed:
    """Lay a model on the panel of a job, inside its frame and margin."""
    return place(mesh, view, job.size, margin=margin_of(job))


def drawing_of(job: Job) -> Drawing:
    """Return which lines a job draws, and how."""
    return Drawing(
        kinds=job.line_kinds,
        detail=job.line_detail,
        min_length=job.line_length,
        width=job.line_width,
        spread=job.line_spread,
    )


def view_part(view: View, placed: Placed) -> Part:
    """Describe a view as report.json does."""
    return {
        "azimuth_deg": view.azimuth,
        "elevation_deg": view.elevation,
        "roll_deg": view.roll,
        "perspective_deg": view.perspective,
        "up": view.up,
        "matrix": placed.matrix.tolist(),
    }


def check_figure(mask: NDArray[np.bool_], grid: Grid, job: Job) -> None:
    """Refuse a figure that comes too near to what the stock has of its own."""
    check_clear(nodes_of(mask), grid, stock_of(job), job.depth)


def make_layers(mesh: Mesh, view: View, job: Job) -> tuple[Layers, Part]:
    """See the model; the part is report.json's `view`."""
    grid, placed = Grid.on_panel(job.size, job.resolution), place_model(mesh, view, job)
    layers = layers_of(placed, grid, drawing=drawing_of(job))
    check_figure(layers.mask, grid, job)
    return layers, view_part(view, placed)


def write_layers(layers: Layers, job: Job, folder: Path) -> None:
    """Write the three images and the drawing: layers/."""
    write_drawing(layers.strokes, job, folder)
    inside = folder / "layers"
    seen = layers.depth[layers.mask]
    span = max(float(np.ptp(seen)), 1e-12)
    near = np.where(layers.mask, (layers.depth - seen.min()) / span, 0.0)
    (inside / "depth.png").write_bytes(png16(near))
    (inside / "lambert.png").write_bytes(png16(layers.shading.mean(axis=0)))
    (inside / "lines.png").write_bytes(png16(1.0 - layers.lines))


def write_drawing(strokes: Sequence[Stroke], job: Job, folder: Path) -> None:
    """Write the drawing alone into a new layers/, where `drawn.read_strokes` finds it."""
    inside = folder / "layers"
    inside.mkdir()
    drawing = strokes_to_svg(strokes, job.size, width=job.line_width)
    (inside / "lines.svg").write_text(drawing, encoding="utf-8")


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


def write_solid(
    solid: Panel, job: Job, folder: Path, *, name: str, picture: bytes | None = None
) -> Part:
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
    files = [f"{job.solid}.{kind}" for kind in job.formats]
    title = {"panel": "relief of", "plaque": "plaque of", "mould": "mould of"}[job.solid]
    for file in files:
        export.write_panel(solid, folder / file, name=f"{title} {name}", picture=picture)
    return {
        "file": files[0],
        "files": files,
        "triangles": len(solid.faces),
        "watertight": solid.watertight,
        "volume_mm3": solid.volume_mm3,
        "max_error_mm": solid.max_error_mm,
        **solids.write_parts(solid, job, folder, f"{title} {name}"),
    }


def plan_paths(
    relief: Relief,
    strokes: Sequence[Stroke],
    job: Job,
    progress: Progress = silent,
    *,
    marks: Marks | None = None,
) -> tuple[Planned, ...]:
    """Plan the toolpaths of a job, position after position."""
    stock = milled_of(job)
    milled, lines = laid(relief, stock), laid_strokes(strokes, stock)
    planned = [
        (
            position,
            plan(
                milled,
                lines,
                machine_of(job),
                profiles.material(job.material),
                cutters=cutters_of(job),
                stock=stock,
                settings=cut_settings(job),
                position=position,
                marks=laid_marks(marks, stock) if marks else None,
                progress=progress,
            ),
        )
        for position in positions_of(job)
    ]
    cut = tuple((position, paths) for position, paths in planned if paths)
    if not cut:
        raise InputError(
            "there is nothing to cut: the relief is shallower than the least cut",
            hint="a larger depth",
        )
    return cut


def write_picture(
    relief: Relief,
    panel: Panel | None,
    job: Job,
    folder: Path,
    bent: Round | Curved | None = None,
) -> tuple[bytes, Part]:
    """Write preview.png; return it small, and how it was made.

    Parameters
    ----------
    relief : Relief
    panel : Panel or None
        Without one, the picture shows the relief.
    job : Job
    folder : Path
    bent : Round or Curved, optional
        The stock that the panel is carved from, where it is not flat.
    """
    file, light = folder / "preview.png", light_at(*job.light)
    if panel is not None and isinstance(bent, Round):
        return _kept(
            standing_picture(panel, light=light, texture=job.texture), "orthographic", file
        )
    if panel is not None and bent is not None:
        picture = solid_picture(panel, relief.grid.pitch, light=light, texture=job.texture)
    else:
        picture = panel_picture(relief, panel, light=light, texture=job.texture)
    return _kept(*picture, file)


def write_solid_picture(solid: Panel, relief: Relief, job: Job, file: Path) -> tuple[bytes, Part]:
    """Write the picture of a plaque or a mould; return it small, and how it was made."""
    pitch, light = relief.grid.pitch, light_at(*job.light)
    return _kept(*solid_picture(solid, pitch, light=light, texture=job.texture), file)


def _kept(image: NDArray[np.uint8], method: str, file: Path) -> tuple[bytes, Part]:
    file.write_bytes(png8(image))
    return png8(smaller(image, THUMBNAIL)), {"file": file.name, "method": method}
