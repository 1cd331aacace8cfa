"""Mesh and view to Layers: the first stage as one call."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.mesh import Mesh
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.raster import rasterise
from relieffab.layers.shading import default_lights, lambert, pixel_normals
from relieffab.layers.strokes import draw_strokes, line_image
from relieffab.layers.view import Placed, View, place

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Drawing:
    """How the lines are drawn.

    Parameters
    ----------
    width : float
        Of a stroke at full strength, mm.
    detail : float
        Forms smaller than this are smoothed away before lines are sought, mm.
    min_length : float
        Shorter lines are left out, mm.
    secondary : float
        Strength of suggestive contours against that of contours, 0 to 1.
    """

    width: float = 0.6
    detail: float = 1.2
    min_length: float = 3.0
    secondary: float = 0.5


def layers_of(placed: Placed, grid: Grid, *, drawing: Drawing | None = None) -> Layers:
    """Take the three aligned images of a model that is already on the panel.

    Parameters
    ----------
    placed : Placed
    grid : Grid
    drawing : Drawing, optional

    Returns
    -------
    Layers

    Raises
    ------
    InputError
        If no pixel shows the model.
    """
    drawing = drawing or Drawing()
    raster = rasterise(placed.vertices, placed.faces, grid)
    mask = raster.mask
    normals = pixel_normals(raster, placed.vertices, placed.faces, grid)
    lights = default_lights()
    strokes = draw_strokes(
        placed.vertices,
        placed.faces,
        raster,
        grid,
        detail=drawing.detail,
        min_length=drawing.min_length,
    )
    strokes = tuple(_weighted(stroke, drawing.secondary) for stroke in strokes)
    return Layers(
        grid=grid,
        depth=np.where(mask, raster.depth, 0.0),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=line_image(strokes, grid, width=drawing.width),
        strokes=strokes,
    )


def _weighted(stroke: Stroke, secondary: float) -> Stroke:
    if stroke.kind != "suggestive":
        return stroke
    return replace(stroke, strength=secondary * stroke.strength)


def make_layers(
    mesh: Mesh,
    view: View,
    *,
    size: tuple[float, float] = (120.0, 90.0),
    resolution: tuple[int, int] = (1024, 768),
    margin: float = 6.0,
    drawing: Drawing | None = None,
) -> Layers:
    """See a model from a view as it will stand on the panel.

    Parameters
    ----------
    mesh : Mesh
    view : View
    size : tuple of float
        Panel's X and Y, mm.
    resolution : tuple of int
        Pixels across and down; square, so the coarser of the two counts.
    margin : float
        Flat border round the figure, mm.
    drawing : Drawing, optional

    Returns
    -------
    Layers
    """
    grid = Grid.on_panel(size, resolution)
    return layers_of(place(mesh, view, size, margin=margin), grid, drawing=drawing)
