"""A job's model, of whatever kind, to its layers and what the report says of them."""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.job import looking
from relieffab.job.settings import Job, default_job
from relieffab.layers.art.art import Art
from relieffab.layers.art.make import ArtSight, placed_on
from relieffab.layers.art.svg import read_svg
from relieffab.layers.art.text import set_text
from relieffab.layers.content import FONT, MESH, PICTURE, content_of
from relieffab.layers.image.ink import InkSight
from relieffab.layers.image.make import (
    Known,
    Showing,
    sight_of_picture,
    told,
)
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.read import read_picture
from relieffab.layers.image.sight import PictureSight
from relieffab.layers.mesh import Mesh, make_mesh, read_mesh
from relieffab.layers.model import Layers
from relieffab.relief.names import LINES, SURFACE

Part = dict[str, Any]
Flat = Picture | Art
Model = Mesh | Flat
Sight = PictureSight | InkSight | ArtSight

OF_MESHES = ("view", "azimuth", "elevation", "roll", "perspective", "up")
OF_PICTURES = ("image", "image_depth", "mask", "depth_map")
"""Settings that say something of models of one kind alone."""

_DEFAULT = default_job()


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
    check_settings(job, kind)
    if kind == MESH:
        return read_mesh(job.model)
    if kind == PICTURE:
        return read_picture(job.model)
    return set_text(job.text or "", job.model) if kind == FONT else read_svg(job.model)


def check_settings(job: Job, kind: str) -> None:
    """Refuse settings that say nothing of a model of this kind."""
    idle: tuple[str, ...] = OF_PICTURES if kind != PICTURE else ()
    idle += OF_MESHES if kind != MESH else ()
    idle += ("text",) if kind != FONT else ()
    wrong = [name for name in idle if getattr(job, name) != getattr(_DEFAULT, name)]
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
    return _flat(model, job, part)


def sight_of(flat: Flat, job: Job, known: Known | None = None) -> Sight:
    """See a picture or art on the panel, before it is drawn.

    Parameters
    ----------
    flat : Picture or Art
    job : Job
    known : Known, optional
        What was found of a picture before.
    """
    grid, margin = Grid.on_panel(job.size, job.resolution), looking.margin_of(job)
    if isinstance(flat, Art):
        matrix = placed_on(flat, job.size, margin=margin)
        outlined, inked = job.carve == LINES, job.carve != SURFACE
        return ArtSight(flat, grid, matrix, outlined=outlined, inked=inked)
    showing = Showing(job.image, job.mask, job.image_depth, job.depth_map)
    return sight_of_picture(flat, grid, job.size, margin=margin, showing=showing, known=known)


def carve_of(sight: Sight, job: Job) -> str:
    """Say what of a picture or art can be carved, of what was asked.

    Raises
    ------
    InputError
        If it has no surface, and nothing else was asked for.
    """
    if sight.lines_only and job.carve == SURFACE:
        raise InputError(
            "there is no surface to carve: all of it is lines",
            where=str(job.model),
            hint="--carve lines, or --image photo for a picture",
        )
    return LINES if sight.lines_only else job.carve


def check_figure(layers: Layers, job: Job) -> None:
    """Refuse a figure that comes too near the panel's edge, its frame or its holes."""
    looking.check_figure(layers.mask | (layers.lines > 0), layers.grid, job)


def _flat(flat: Flat, job: Job, part: Part) -> Seen:
    sight, drawing = sight_of(flat, job), looking.drawing_of(job)
    carve = carve_of(sight, job)
    layers = sight.layers(sight.strokes(drawing), drawing)
    check_figure(layers, job)
    return Seen(layers, part | _facts(flat, sight), {"matrix": sight.matrix}, carve)


def _facts(flat: Flat, sight: Sight) -> Part:
    facts, notes = dict(sight.facts), [*flat.notes]
    if isinstance(flat, Picture):
        facts |= {"width": flat.shape[1], "height": flat.shape[0]}
        facts |= {"bits": flat.bits, "format": flat.format}
        notes += told(facts)
    return {**facts, "notes": [*notes, *sight.notes]}
