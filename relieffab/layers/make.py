"""Mesh and view to Layers: the first stage as one call."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.image import line_image, spread_ink
from relieffab.layers.lines.strokes import draw_strokes
from relieffab.layers.lines.study import Study
from relieffab.layers.mesh import Mesh
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.raster import Raster, rasterise
from relieffab.layers.shading import Groups, default_lights, lambert, pixel_normals
from relieffab.layers.view import Placed, View, place

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Sight:
    """What is seen of a model on the panel, before it is drawn.

    Parameters
    ----------
    placed : Placed
    grid : Grid
    raster : Raster
    normals : (rows, cols, 3) ndarray
        At pixels, unit.
    """

    placed: Placed
    grid: Grid
    raster: Raster
    normals: Floats

    @classmethod
    def of(cls, placed: Placed, grid: Grid, *, groups: Groups | None = None) -> "Sight":
        """Look at a model; `groups` are of its corners, from `smoothing_groups`, if at hand."""
        raster = rasterise(placed.vertices, placed.faces, grid)
        normals = pixel_normals(raster, placed.vertices, placed.faces, grid, groups=groups)
        return cls(placed, grid, raster, normals)

    def strokes(self, drawing: Drawing, *, study: Study | None = None) -> tuple[Stroke, ...]:
        """Draw it; `study` is of the model as it lies here, if at hand."""
        return draw_strokes(self.placed, self.raster, self.grid, drawing, study=study)

    def layers(self, strokes: tuple[Stroke, ...], drawing: Drawing) -> Layers:
        """Put the images together, the strokes as ink.

        Raises
        ------
        InputError
            If no pixel shows the model.
        """
        mask, lights = self.raster.mask, default_lights()
        dark = [stroke for stroke in strokes if not stroke.light]
        ink = line_image(dark, self.grid, width=drawing.width)
        return Layers(
            grid=self.grid,
            depth=np.where(mask, self.raster.depth, 0.0),
            normals=self.normals,
            mask=mask,
            lights=lights,
            shading=lambert(self.normals, lights) * mask,
            lines=spread_ink(ink, drawing.spread, self.grid),
            strokes=strokes,
        )


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
    sight = Sight.of(placed, grid)
    return sight.layers(sight.strokes(drawing), drawing)


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
