"""A picture to Layers: what `layers.make` is for a mesh."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.image.figure import SEGMENTED, Figure, find_figure
from relieffab.layers.image.fit import Fit, fit_on
from relieffab.layers.image.ink import InkSight
from relieffab.layers.image.kind import check_shown, kind_of
from relieffab.layers.image.maps import Laid, form_of_depth, form_of_normals
from relieffab.layers.image.names import (
    DEPTH,
    DEPTH_FAR,
    DRAWING,
    NORMAL,
    NORMAL_DOWN,
    PHOTO,
)
from relieffab.layers.image.outline import faint_share
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.read import read_picture
from relieffab.layers.image.shape import brightness, shape_of
from relieffab.layers.image.sight import Facts, PictureSight
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.model import Layers
from relieffab.layers.shading import default_lights, lambert

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True)
class Showing:
    """How a picture is meant.

    Parameters
    ----------
    kind : str or None
        One of `names.NAMES`; found from its values if not given.
    mask : str or None
        A mask's file, white where the figure is.
    deep : float or None
        Of a depth map, from its farthest to its nearest point as large as the
        figure stands on the panel, mm; half the figure's shorter side if not given.
    depth_map : str or None
        The file of a depth map that goes with a normal map.
    """

    kind: str | None = None
    mask: str | None = None
    deep: float | None = None
    depth_map: str | None = None


@dataclass(frozen=True, eq=False)
class Seen:
    """Layers of a picture, and what was found on the way.

    Parameters
    ----------
    layers : Layers
    fit : Fit
        Where the picture lies on the panel.
    facts : dict
        As report.json says them.
    notes : tuple of str
        What a person should know of it.
    """

    layers: Layers
    fit: Fit
    facts: Facts
    notes: tuple[str, ...]


def figure_of(picture: Picture, kind: str, mask: Picture | None = None) -> Figure:
    """Find the figure's pixels in a picture of a kind; `mask` shows it white, if given."""
    return find_figure(picture, mask, even=kind != PHOTO)


@dataclass(frozen=True, eq=False)
class Known:
    """What was found of a picture before.

    Parameters
    ----------
    kind : str
        By its values.
    figure : Figure or None
        From `figure_of`, of the kind that it is taken for.
    """

    kind: str
    figure: Figure | None = None


def sight_of_picture(
    picture: Picture,
    grid: Grid,
    size: tuple[float, float],
    *,
    margin: float,
    showing: Showing | None = None,
    known: Known | None = None,
) -> PictureSight | InkSight:
    """See a picture on the panel; parameters and errors as for `layers_of_picture`.

    With what is known of it nothing of that is looked for, nor is a mask's file read.
    """
    showing = showing or Showing()
    check_shown(picture)
    kind = showing.kind or (known.kind if known else kind_of(picture))
    facts: Facts = {"kind": kind, "kind_by": "setting" if showing.kind else "values"}
    _check_depth_map(showing, kind, picture.name)
    if kind == DRAWING:
        return InkSight.of(picture, grid, size, margin, facts)
    if known and known.figure:
        mask, source = known.figure
    else:
        given = read_picture(showing.mask) if showing.mask else None
        mask, source = figure_of(picture, kind, given)
    fit = fit_on(mask, grid, size, margin=margin)
    there = fit.mask(mask)
    if not there.any():
        raise InputError("the figure is too small to be seen on the panel", where=picture.name)
    facts["mask"] = source
    if source == SEGMENTED:
        facts["faint_outline"] = faint_share(picture.values, mask)
    grey = None
    laid = Laid(picture, mask, source, fit, there)
    if kind in (DEPTH, DEPTH_FAR):
        far = kind == DEPTH_FAR
        depth, normals = form_of_depth(laid, facts, far=far, deep=showing.deep)
    elif kind == PHOTO:
        grey = fit.field(brightness(picture), mask)
        depth, normals = shape_of(grey, there, grid.pitch, facts)
    else:
        down = kind == NORMAL_DOWN
        depth, normals = form_of_normals(laid, facts, down=down, depth_map=showing.depth_map)
    return PictureSight(fit, _assemble(grid, depth, normals, there), facts, grey)


def _check_depth_map(showing: Showing, kind: str, name: str) -> None:
    if not showing.depth_map:
        return
    if kind not in (NORMAL, NORMAL_DOWN):
        raise InputError(
            "--depth-map goes with a normal map alone",
            found=f"a picture taken for a {kind}",
            where=name,
            hint="--image normal if it is one; a depth map alone is the model itself",
        )
    if showing.deep is not None:
        raise InputError(
            "--image-depth says nothing of a depth map beside a normal map: its normals say it",
            where=showing.depth_map,
        )


def layers_of_picture(
    picture: Picture,
    grid: Grid,
    size: tuple[float, float],
    *,
    margin: float,
    showing: Showing | None = None,
    drawing: Drawing | None = None,
) -> Seen:
    """Take the three aligned images from a picture.

    Parameters
    ----------
    picture : Picture
    grid : Grid
    size : tuple of float
        The panel's X and Y, mm.
    margin : float
        Flat border round the figure, mm.
    showing : Showing, optional
    drawing : Drawing, optional

    Returns
    -------
    Seen

    Raises
    ------
    InputError
        If it shows nothing of the kind.
    """
    drawing = drawing or Drawing()
    sight = sight_of_picture(picture, grid, size, margin=margin, showing=showing)
    layers = sight.layers(sight.strokes(drawing), drawing)
    return Seen(layers, sight.fit, sight.facts, (*told(sight.facts), *sight.notes))


def told(facts: Facts) -> tuple[str, ...]:
    """Note what was found of a picture where nobody said it."""
    taken = f"taken for a {facts['kind']}: --image says otherwise"
    found = (taken,) if facts["kind_by"] == "values" else ()
    return (*found, f"the figure: by {facts['mask']}") if "mask" in facts else found


def _assemble(grid: Grid, depth: Floats, normals: Floats, mask: Bools) -> Layers:
    lights = default_lights()
    return Layers(
        grid=grid,
        depth=np.where(mask, depth, 0.0),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=np.zeros(grid.shape),
    )
