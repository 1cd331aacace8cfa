"""Mesh and view to Layers: the first stage as one call."""

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.image import line_image, spread_ink
from relieffab.layers.lines.strokes import draw_strokes
from relieffab.layers.mesh import Mesh
from relieffab.layers.model import Layers
from relieffab.layers.raster import rasterise
from relieffab.layers.shading import default_lights, lambert, pixel_normals
from relieffab.layers.view import Placed, View, place

Floats = NDArray[np.float64]


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
    strokes = draw_strokes(placed, raster, grid, drawing)
    dark = [stroke for stroke in strokes if not stroke.light]
    ink = line_image(dark, grid, width=drawing.width)
    return Layers(
        grid=grid,
        depth=np.where(mask, raster.depth, 0.0),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=spread_ink(ink, drawing.spread, grid),
        strokes=strokes,
    )


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
