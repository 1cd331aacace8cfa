"""The one picture that shows what a job is going to carve."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.grid import Grid
from relieffab.picture.above import heights_above, solid_heights
from relieffab.picture.render import OpenGLMissingError, TriangleMesh, render_panel
from relieffab.picture.stone import LIGHT, hillshade, shade
from relieffab.picture.texture import Texture
from relieffab.relief.model import Relief

Floats = NDArray[np.float64]
Method = Literal["pyrender", "hillshade"]


def panel_picture(
    relief: Relief,
    panel: TriangleMesh | None = None,
    *,
    width: int = 1600,
    light: ArrayLike = LIGHT,
    texture: Texture = "stone",
) -> tuple[NDArray[np.uint8], Method]:
    """Picture a relief for presentation.

    Parameters
    ----------
    relief : Relief
    panel : TriangleMesh, optional
        The solid it is sunk into: anything with `vertices` and `faces`.
    width : int
        Of the picture in perspective, pixels.
    light : (3,) array_like
        Towards the key light.
    texture : {'stone', 'wood'}
        What it is carved in.

    Returns
    -------
    image : (h, w, 3) ndarray of uint8
    method : str
        'pyrender' for the panel in perspective; 'hillshade' for the relief seen
        straight on, where there is no panel or no OpenGL.
    """
    if panel is None:
        return hillshade(relief, light, texture=texture), "hillshade"
    heights = heights_above(relief, panel)
    return _drawn(panel, relief.grid, heights, width, light, texture)


def solid_picture(
    solid: TriangleMesh,
    pitch: float,
    *,
    width: int = 1600,
    light: ArrayLike = LIGHT,
    texture: Texture = "stone",
) -> tuple[NDArray[np.uint8], Method]:
    """Picture any solid that lies on its back, a plaque or a mould.

    Parameters
    ----------
    solid : TriangleMesh
    pitch : float
        Side of a pixel of its shading, mm.
    width : int
        Of the picture in perspective, pixels.
    light : (3,) array_like
        Towards the key light.
    texture : {'stone', 'wood'}
        What it is carved in.

    Returns
    -------
    image : (h, w, 3) ndarray of uint8
    method : str
        As `panel_picture`.
    """
    return _drawn(solid, *solid_heights(solid, pitch), width, light, texture)


def _drawn(
    solid: TriangleMesh,
    grid: Grid,
    heights: Floats,
    width: int,
    light: ArrayLike,
    texture: Texture,
) -> tuple[NDArray[np.uint8], Method]:
    """Draw a solid whose heights seen from above are known at a grid's nodes, mm."""
    face = shade(heights, grid.pitch, light, texture=texture)
    try:
        image = render_panel(solid, face, grid, width=width, light=light, texture=texture)
    except OpenGLMissingError:
        return face, "hillshade"
    return image, "pyrender"
