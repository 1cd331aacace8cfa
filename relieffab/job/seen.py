"""A job's model, of whatever kind, to its layers and what the report says of them."""

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.job import looking
from relieffab.job.settings import Job
from relieffab.layers.art.art import Art
from relieffab.layers.art.make import layers_of_art, placed_on
from relieffab.layers.art.svg import read_svg
from relieffab.layers.art.text import set_text
from relieffab.layers.content import FONT, MESH, PICTURE, content_of
from relieffab.layers.image.make import Showing, layers_of_picture
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.read import read_picture
from relieffab.layers.mesh import Mesh, make_mesh, read_mesh
from relieffab.layers.model import Layers
from relieffab.relief.names import LINES, SURFACE

Part = dict[str, Any]
Model = Mesh | Picture | Art

_OF_MESHES = ("azimuth", "elevation", "up")
_OF_PICTURES = ("image", "image_depth", "mask", "depth_map")


@dataclass(frozen=True, eq=False)
class Seen:
    """What a job's model shows.

    Parameters
    ----------
    layers : Layers
    model : dict
        What report.json holds as `model`.
    view : dict
        The same as `view`.
    carve : str
        What of it can be carved, of what was asked.
    """

    layers: Layers
    model: Part
    view: Part
    carve: str


def read_model(job: Job) -> Model:
    """Read the job's model; without one, the toolkit's own scarab is modelled.

    Raises
    ------
    InputError
        If it cannot be read, or settings are given that models of its kind do not have.
    """
    if job.model is None:
        from relieffab.subject import scarab

        vertices, faces = scarab()
        return make_mesh(vertices, faces, name="scarab", usual_up="y")
    kind = content_of(job.model)
    _check_settings(job, kind)
    if kind == MESH:
        return read_mesh(job.model)
    if kind == PICTURE:
        return read_picture(job.model)
    return set_text(job.text or "", job.model) if kind == FONT else read_svg(job.model)


def _check_settings(job: Job, kind: str) -> None:
    wrong = [name for name in _OF_PICTURES if kind != PICTURE and getattr(job, name) is not None]
    if kind != MESH:
        wrong += [name for name in _OF_MESHES if getattr(job, name) is not None]
        wrong += ["perspective"] * (job.perspective != 0) + ["view"] * (job.view != "front")
        wrong += ["roll"] * (job.roll != 0)
    wrong += ["text"] * (kind != FONT and job.text is not None)
    if wrong:
        flags = ", ".join("--" + name.replace("_", "-") for name in wrong)
        raise InputError(
            f"{flags} says nothing of a model of this kind",
            found={"svg": "an SVG"}.get(kind, f"a {kind}"),
            where=str(job.model),
        )
    if kind == FONT and job.text is None:
        raise InputError(
            "a font is there to write with", expected="--text WORDS", where=str(job.model)
        )


def look_at(model: Model, job: Job) -> Seen:
    """Take a model's layers.

    Raises
    ------
    InputError
        If it shows nothing that can be carved, or not what was asked for.
    """
    sha = hashlib.sha256(Path(job.model).read_bytes()).hexdigest() if job.model else None
    if isinstance(model, Mesh):
        view, note = looking.view_of(job, model)
        layers, seen = looking.make_layers(model, view, job)
        part = looking.model_part(model, sha)
        part["notes"] += [note] if note else []
        return Seen(layers, part, seen, job.carve)
    part = {"name": model.name, "notes": list(model.notes), "sha256": sha}
    return _picture(model, job, part) if isinstance(model, Picture) else _art(model, job, part)


def _picture(picture: Picture, job: Job, part: Part) -> Seen:
    seen = layers_of_picture(
        picture,
        Grid.on_panel(job.size, job.resolution),
        job.size,
        margin=looking.margin_of(job),
        showing=Showing(job.image, job.mask, job.image_depth, job.depth_map),
        drawing=looking.drawing_of(job),
    )
    facts = {**seen.facts, "width": picture.shape[1], "height": picture.shape[0]}
    facts |= {"bits": picture.bits, "format": picture.format}
    part = {**part, **facts, "notes": [*part["notes"], *seen.notes]}
    layers = seen.layers
    carve = _lines_only(job, picture.name) if layers.level else job.carve
    return _checked(Seen(layers, part, {"matrix": seen.fit.matrix}, carve), job)


def _art(art: Art, job: Job, part: Part) -> Seen:
    matrix = placed_on(art, job.size, margin=looking.margin_of(job))
    outlined = job.carve == LINES
    grid = Grid.on_panel(job.size, job.resolution)
    drawing = looking.drawing_of(job)
    layers = layers_of_art(art, grid, matrix, outlined=outlined, drawing=drawing)
    filled = any(mark.fill and not mark.paper for mark in art.marks)
    carve = job.carve if filled else _lines_only(job, art.name)
    part |= {"kind": art.kind, "marks": len(art.marks)}
    if carve == SURFACE:
        layers = replace(layers, lines=0.0 * layers.lines, strokes=_outlines(layers))
    return _checked(Seen(layers, part, {"matrix": matrix}, carve), job)


def _outlines(layers: Layers) -> tuple[Any, ...]:
    return tuple(stroke for stroke in layers.strokes if stroke.kind == "outline")


def _lines_only(job: Job, name: str) -> str:
    if job.carve == SURFACE:
        raise InputError(
            "there is no surface to carve: all of it is lines",
            where=name,
            hint="--carve lines, or --image photo for a picture",
        )
    return LINES


def _checked(seen: Seen, job: Job) -> Seen:
    """Refuse a figure that comes too near the panel's edge, its frame or its holes."""
    looking.check_figure(seen.layers.mask | (seen.layers.lines > 0), seen.layers.grid, job)
    return seen
