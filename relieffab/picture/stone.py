"""A relief as carved stone or wood under a raking light, from its height field alone."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError
from relieffab.picture.texture import Texture, colour_of
from relieffab.relief.model import Relief, pixel_slopes

Floats = NDArray[np.float64]

# From the upper left, as pictures of reliefs are lit by custom; 32 degrees high.
LIGHT = (-1.0, 1.0, 0.9)
KEY, SKY, BOUNCE = 1.1, 0.2, 0.12
GAMMA = 2.2


def unit_light(light: ArrayLike) -> Floats:
    """Normalise a direction towards a light that stands above the panel.

    Parameters
    ----------
    light : (3,) array_like
        X right, Y away from the operator, Z to the viewer.
    """
    vector = np.asarray(light, float)
    if vector.shape != (3,) or not (np.isfinite(vector).all() and vector[2] > 0):
        raise InputError(
            "the light does not stand above the panel",
            expected="three numbers, the last more than 0",
            found=str(vector.tolist()),
        )
    return vector / np.linalg.norm(vector)


def pixel_normals(heights: Floats, pitch: float) -> Floats:
    """Find unit normals of pixels from their four corner nodes (Wang 2011, Sect. 5).

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    pitch : float
        Side of a pixel, mm.

    Returns
    -------
    ndarray (rows, cols, 3)
    """
    p, q = pixel_slopes(heights, pitch)
    normals = np.stack([-p, -q, np.ones_like(p)], axis=2)
    return normals / np.linalg.norm(normals, axis=2, keepdims=True)


def relit(relief: Relief, light: ArrayLike = LIGHT) -> Floats:
    """Shade a relief by Lambert's law alone, without shadows: max(0, n·m).

    Parameters
    ----------
    relief : Relief
    light : (3,) array_like
        Towards the light.

    Returns
    -------
    ndarray (rows, cols)
        0 to 1.
    """
    normals = pixel_normals(relief.heights, relief.grid.pitch)
    return np.maximum(normals @ unit_light(light), 0.0)


def _centres(heights: Floats) -> NDArray[np.float32]:
    """Heights of pixel centres, mm."""
    h = heights
    return ((h[:-1, :-1] + h[:-1, 1:] + h[1:, :-1] + h[1:, 1:]) / 4).astype(np.float32)


def _offsets(direction: Floats, reach: float, growth: float) -> list[tuple[int, int, float]]:
    """Whole-pixel steps along a direction, ever farther: (rows, columns, length)."""
    steps: dict[tuple[int, int], float] = {}
    distance = 1.0
    while distance <= max(reach, 1.0):
        row, col = round(-direction[1] * distance), round(direction[0] * distance)
        steps[row, col] = float(np.hypot(row, col))
        distance = max(distance + 1.0, distance * growth)
    steps.pop((0, 0), None)
    return [(row, col, length) for (row, col), length in steps.items()]


def horizon(
    heights: NDArray[np.float32],
    pitch: float,
    direction: ArrayLike,
    *,
    growth: float = 1.0,
    least: float = 0.15,
) -> NDArray[np.float32]:
    """Tangent of the horizon's elevation seen from every pixel, one way.

    Parameters
    ----------
    heights : (rows, cols) ndarray
        At pixel centres, mm, none above 0; beyond the border they go on.
    pitch : float
        Side of a pixel, mm.
    direction : (2,) array_like
        X and Y of the way to look.
    growth : float
        Ratio of successive distances; 1 looks at every pixel on the way.
    least : float
        Elevations below this tangent do not matter, and bound the search.

    Returns
    -------
    ndarray (rows, cols)
        0 where nothing stands higher.
    """
    way = np.asarray(direction, float)
    way = way / np.linalg.norm(way)
    rows, cols = heights.shape
    offsets = _offsets(way, float(-heights.min(initial=0)) / (least * pitch), growth)
    pad = max((max(abs(r), abs(c)) for r, c, _ in offsets), default=0)
    wide = np.pad(heights, pad, mode="edge")
    highest = np.zeros_like(heights)
    for row, col, length in offsets:
        seen = wide[pad + row : pad + row + rows, pad + col : pad + col + cols]
        np.maximum(highest, (seen - heights) * np.float32(1 / (length * pitch)), out=highest)
    return highest


def lit(heights: NDArray[np.float32], pitch: float, light: Floats) -> NDArray[np.float32]:
    """Share of a small sun that each pixel sees, 0 (in shadow) to 1.

    The sun's disc is 6 degrees across, which softens a shadow's edge.
    """
    flat = float(np.hypot(light[0], light[1]))
    if flat < 1e-6:
        return np.ones_like(heights)
    elevation = np.arctan2(light[2], flat)
    half = np.radians(3.0)
    block = np.arctan(
        horizon(heights, pitch, light[:2], least=max(0.1, float(np.tan(elevation - half))))
    )
    return np.clip((elevation + half - block) / (2 * half), 0, 1)


def sky(heights: NDArray[np.float32], pitch: float, ways: int = 8) -> NDArray[np.float32]:
    """Share of an even sky that each pixel sees: cos² of the horizon, averaged."""
    total = np.zeros_like(heights)
    for angle in 2 * np.pi * (np.arange(ways) + 0.5) / ways:
        tangent = horizon(heights, pitch, (np.cos(angle), np.sin(angle)), growth=1.4)
        total += 1 / (1 + tangent * tangent)
    return total / np.float32(ways)


def _binomial(image: Floats) -> Floats:
    """Average each pixel with its neighbours, 1/4 1/2 1/4 both ways, borders repeated."""
    wide = np.pad(image, ((1, 1), (1, 1)) + ((0, 0),) * (image.ndim - 2), mode="edge")
    rows = (wide[:-2] + 2 * wide[1:-1] + wide[2:]) / 4
    return np.asarray((rows[:, :-2] + 2 * rows[:, 1:-1] + rows[:, 2:]) / 4)


def _even_walls(linear: Floats, upright: Floats) -> Floats:
    """Smooth the picture on steep walls, where pixels are steps and shading them is noise.

    Parameters
    ----------
    linear : (rows, cols, 3) ndarray
    upright : (rows, cols) ndarray
        Z of the normals: 1 on the flat, 0 on a wall.
    """
    weight = _binomial(_binomial(np.clip((0.6 - upright) / 0.2, 0, 1)))
    weight = np.minimum(2 * weight, 1)[..., None]
    return (1 - weight) * linear + weight * _binomial(_binomial(linear))


def shade(
    heights: Floats, pitch: float, light: ArrayLike = LIGHT, *, texture: Texture = "stone"
) -> NDArray[np.uint8]:
    """Picture a surface: Lambert, cast shadow, and the sky's soft light.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    pitch : float
        Side of a pixel, mm.
    light : (3,) array_like
        Towards the key light.
    texture : {'stone', 'wood'}
        What it is carved in.

    Returns
    -------
    ndarray (rows, cols, 3) of uint8
        One pixel of the picture for each of the surface's; sRGB-like.
    """
    towards = unit_light(light)
    normals, centres = pixel_normals(heights, pitch), _centres(heights - heights.max(initial=0.0))
    key = np.maximum(normals @ towards, 0.0) * lit(centres, pitch, towards)
    open_sky = sky(centres, pitch)
    colour = colour_of(texture, centres, pitch)
    # What the sky does not light, the walls do, in their own colour.
    grey = KEY * key + SKY * open_sky
    glow = BOUNCE * (1 - open_sky)
    linear = (grey[..., None] + glow[..., None] * colour) * colour
    linear = _even_walls(linear, normals[..., 2])
    return np.rint(255 * np.clip(linear, 0, 1) ** (1 / GAMMA)).astype(np.uint8)


def hillshade(
    relief: Relief, light: ArrayLike = LIGHT, *, texture: Texture = "stone"
) -> NDArray[np.uint8]:
    """Picture a relief as `shade` does."""
    return shade(relief.heights, relief.grid.pitch, light, texture=texture)
