"""A solid that stands upright, as carved stone: from the front, and turned."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage
from scipy.spatial import ConvexHull

from relieffab.grid import Grid
from relieffab.picture.above import nodes_over
from relieffab.picture.render import TriangleMesh
from relieffab.picture.stone import (
    GAMMA,
    KEY,
    LIGHT,
    SKY,
    lit,
    pixel_normals,
    sky,
    unit_light,
)
from relieffab.picture.texture import Texture, plain_colour

Floats = NDArray[np.float64]

ELEVATION = 17.0  # degrees that the eye is above the level
TURNS = (0.0, 50.0)  # degrees that the solid is turned, picture by picture
GROUND = (178, 172, 163)  # what is behind, 0 to 255
FILL = 0.92  # share of the picture that the solid takes, one way or the other
DEEPEST = 8.0  # mm below the uncut face that shadows are worked out for
SIDE, FROM_SIDE = (1.0, 0.2, 0.8), 0.3  # a second light, so that no side is black
SMOOTH = 10.0  # pixels over which the uncut face's facets are evened out
SHARPER = 2  # pixels drawn for one shown, each way


def turned_to(vertices: Floats, turn: float, elevation: float = ELEVATION) -> Floats:
    """Turn a standing solid so that an eye in front of it and above looks down along Z.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        Z up, the front facing -Y, mm.
    turn : float
        About Z, counter-clockwise seen from above, degrees.
    elevation : float
        Degrees.

    Returns
    -------
    (v, 3) ndarray
        X to the right, Y up in the picture, Z towards the eye, mm.
    """
    a, e = np.radians((turn, elevation))
    x, y, z = vertices.T
    across, away = x * np.cos(a) - y * np.sin(a), x * np.sin(a) + y * np.cos(a)
    up = z * np.cos(e) + away * np.sin(e)
    return np.stack([across, up, z * np.sin(e) - away * np.cos(e)], axis=1)


def standing_picture(
    solid: TriangleMesh,
    *,
    width: int = 1400,
    turns: Sequence[float] = TURNS,
    light: ArrayLike = LIGHT,
    texture: Texture = "stone",
) -> NDArray[np.uint8]:
    """Picture a standing solid, once for each way it is turned, without perspective.

    Parameters
    ----------
    solid : TriangleMesh
        Anything with `vertices` and `faces`, as `make_round` makes a column.
    width : int
        Of the picture, pixels.
    turns : sequence of float
        Degrees.
    light : (3,) array_like
        Towards the key light, from the eye's own place.
    texture : 'stone' or 'wood'
        Whose colour it has.

    Returns
    -------
    (h, w, 3) ndarray of uint8
    """
    seen = [turned_to(np.asarray(solid.vertices), turn) for turn in turns]
    boxes = np.array([[view.min(axis=0), view.max(axis=0)] for view in seen])
    size = (boxes[:, 1] - boxes[:, 0]).max(axis=0)[:2]
    cols = width // len(turns)
    pitch = float(size[0]) / (FILL * cols)
    rows = max(round(float(size[1]) / (FILL * pitch)), 1)
    pictures = []
    for view, box in zip(seen, boxes, strict=True):
        middle = box[:, :2].mean(axis=0)
        corner = middle + np.array([-cols, rows]) * (pitch / 2)
        place = (float(corner[0]), float(corner[1]))
        grid = Grid(rows * SHARPER, cols * SHARPER, pitch / SHARPER, place)
        pictures.append(_shaded(_Seen(view, np.asarray(solid.faces)), grid, light, texture))
    return np.concatenate(pictures, axis=1)


@dataclass(frozen=True, eq=False)
class _Seen:
    """A mesh seen from somewhere: `TriangleMesh`."""

    vertices: Floats
    faces: NDArray[np.integer]


def _shaded(solid: _Seen, grid: Grid, light: ArrayLike, texture: Texture) -> NDArray[np.uint8]:
    """Shade what is seen, and bring it down to the pixels shown."""
    heights, seen = nodes_over(solid, grid)
    hull = ConvexHull(solid.vertices).simplices
    around, _ = nodes_over(_Seen(solid.vertices, hull), grid)
    # Only what is sunk casts shadows, as deep as it is square to the uncut face.
    upright = pixel_normals(np.pad(around, ((0, 1), (0, 1)), mode="edge"), grid.pitch)[..., 2]
    upright = ndimage.gaussian_filter(upright, SMOOTH)  # facets would show
    sunk = np.where(seen, np.maximum((heights - around) * upright, -DEEPEST), 0.0)
    sunk = sunk.astype(np.float32)[::SHARPER, ::SHARPER]
    finer = np.ones((SHARPER, SHARPER), np.float32)
    open_sky = np.kron(sky(sunk, grid.pitch * SHARPER), finer)
    edge = np.where(seen, heights, heights[seen].min())
    normals = pixel_normals(np.pad(edge, ((0, 1), (0, 1)), mode="edge"), grid.pitch)
    key, fill = (unit_light(one) for one in (light, SIDE))
    shown = np.kron(lit(sunk, grid.pitch * SHARPER, key), finer)
    grey = KEY * np.maximum(normals @ key, 0.0) * shown
    grey += FROM_SIDE * np.maximum(normals @ fill, 0.0) + SKY * open_sky
    linear = np.clip(grey, 0, 1)[..., None] * plain_colour(texture)
    coloured = 255 * linear ** (1 / GAMMA)
    image = np.where(seen[..., None], coloured, GROUND)
    rows, cols = image.shape[0] // SHARPER, image.shape[1] // SHARPER
    even = image.reshape(rows, SHARPER, cols, SHARPER, 3).mean(axis=(1, 3))
    return np.asarray(np.rint(even), np.uint8)
