"""How a job sees its model: the view, the place on the panel, the three images."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.job.settings import Job
from relieffab.job.stocks import stock_of
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.svg import strokes_to_svg
from relieffab.layers.make import layers_of
from relieffab.layers.mesh import Mesh
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.view import VIEWS, Placed, View, guess_up, place
from relieffab.panel.sinking import check_clear
from relieffab.picture import png16
from relieffab.relief.model import nodes_of

Part = dict[str, Any]

SCARAB_UP = "y"  # of the model carved where no file is named


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
