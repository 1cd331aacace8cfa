"""Shape from the shading of one photograph, coarse to fine.

On each of a pyramid's levels the surface settles into the photograph (see `likeness`),
from what the coarser one found; on the coarsest from the body that the outline suggests.
Light from the side tells hills from valleys; under light from the front both look alike,
and what is dark is taken for deep (Langer and Bülthoff 2000), as it is in grooves.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.image.inflate import inflate
from relieffab.layers.image.light import ROUND, Light, find_light
from relieffab.layers.image.likeness import Photograph
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.settle import settle
from relieffab.layers.image.steps import normals_of, slopes_of

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Level = tuple[Floats, Bools]
"""Brightness and figure."""

COARSEST = 96
"""Pixels each way at most on the coarsest level."""
LIT = 256
"""The same, where the light is sought."""
ROUNDS = (60, 40, 20, 10, 8)
"""Steps on each level from the coarsest, the last for all finer ones too: more follow the picture
into what it does not tell."""
THICK = 0.6
"""Of a round body's thickness: few figures are as thick as they are wide."""
FLAT = 0.3
"""The same, where the shading says that the figure is no such body."""
FACING = 0.001
"""Weight of facing the viewer."""
BEND, BEND_FRONTAL = 0.003, 0.1
"""Weight of bending, under light from the side, and from the front on the coarsest level."""
EASED = 0.4
"""What is left of the latter on the next level."""
HOLD = 1e-6
"""How firmly the body holds the surface, of what a pixel weighs."""
FRONTAL = 0.8
"""n_z of a light from which hills and valleys begin to look alike."""
DEEP = 2.0
"""Depth of what is dark there, pixels of each level."""
AROUND = 4.0
"""Dark against what lies so far around, pixels of each level."""


def brightness(picture: Picture) -> Floats:
    """Brightness in linear light, 0 to 1: whole numbers are sRGB, floating point is linear."""
    grey = np.nan_to_num(picture.grey)
    if picture.bits is not None:
        return np.where(grey <= 0.04045, grey / 12.92, ((grey + 0.055) / 1.055) ** 2.4)
    return grey


def _half(level: Level) -> Level:
    """Take means of two by two pixels; of the figure's alone."""
    grey, mask = level
    pad = [(0, n % 2) for n in mask.shape]
    shape = [(n + 1) // 2 for n in mask.shape]
    mass, total = (
        np.pad(v, pad).reshape(shape[0], 2, shape[1], 2).mean(axis=(1, 3))
        for v in (mask.astype(float), np.where(mask, grey, 0.0))
    )
    there = mass >= 0.5
    return np.divide(total, mass, out=np.zeros(mass.shape), where=there), there


def _pyramid(level: Level) -> list[Level]:
    """Levels from the coarsest to the one given."""
    levels = [level]
    while max(levels[0][1].shape) > COARSEST and _half(levels[0])[1].any():
        levels.insert(0, _half(levels[0]))
    return levels


def _corners(pixels: Floats) -> Floats:
    """Take values of pixels to their corners."""
    wide = np.pad(pixels, 1, mode="edge")
    return 0.25 * (wide[1:, 1:] + wide[1:, :-1] + wide[:-1, 1:] + wide[:-1, :-1])


def _finer(z: Floats, shape: tuple[int, int]) -> Floats:
    """Take depth at corners to a grid twice as fine, in its pixels."""
    at = np.meshgrid(*(np.arange(n + 1) / 2 for n in shape), indexing="ij")
    return np.asarray(2.0 * ndimage.map_coordinates(z, at, order=1, mode="nearest"))


def _deep(shade: Floats, mask: Bools, sigma: float) -> Floats:
    """Depth of what is darker than what lies around, at corners, negative where it is."""
    fine, wide = (
        ndimage.gaussian_filter(shade * mask, s)
        / np.maximum(ndimage.gaussian_filter(mask.astype(float), s), 1e-9)
        for s in (0.7, sigma)
    )
    return _corners(np.where(mask, fine - wide, 0.0))


def _descend(levels: list[Level], light: Light) -> Floats:
    """Settle on level after level; the depth at the finest one's corners, pixels."""
    thick = THICK if light.fit >= ROUND else FLAT
    frontal = max(0.0, (light.way[2] - FRONTAL) / (1.0 - FRONTAL))
    z = np.zeros((1, 1))
    for k, (grey, mask) in enumerate(levels):
        body = thick * _corners(inflate(mask, 1.0))
        shade = light.cosine(grey)
        z = _finer(z, mask.shape) if k else body
        if frontal > 0.0:
            z = z + frontal * DEEP * _deep(shade, mask, AROUND if k else float(max(mask.shape)))
        hold = HOLD * 4.0 ** (len(levels) - 1 - k)
        bend = BEND + frontal * BEND_FRONTAL * EASED**k
        seen = Photograph(shade, mask, light.way, FACING, bend)
        z = settle(z, seen, ROUNDS[min(k, len(ROUNDS) - 1)], reference=body, hold=hold)
    return z


def _light(levels: list[Level]) -> Light:
    """Ask the finest level that is coarse enough."""
    few = [level for level in levels if max(level[1].shape) <= LIT]
    grey, mask = few[-1] if few else levels[0]
    body = slopes_of(THICK * inflate(mask, 1.0), mask, 1.0)
    return find_light(grey, normals_of(body, mask), mask)


def shape_of(
    grey: Floats, mask: Bools, pitch: float, facts: dict[str, Any]
) -> tuple[Floats, Floats]:
    """Find depth and normals of what a photograph shows.

    Parameters
    ----------
    grey : (rows, cols) ndarray
        Brightness, linear.
    mask : (rows, cols) ndarray of bool
        The figure.
    pitch : float
        mm.
    facts : dict
        Gets `light` and `light_fit`.

    Returns
    -------
    depth : (rows, cols) ndarray
        mm, the nearest point at 0; 0 outside the figure.
    normals : (rows, cols, 3) ndarray
    """
    window = ndimage.find_objects(mask.astype(np.int8))[0]
    levels = _pyramid((np.where(mask, grey, 0.0)[window], mask[window]))
    light = _light(levels)
    z = _descend(levels, light)
    right, down = np.diff(z, axis=1), np.diff(z, axis=0)
    slopes = np.zeros((2, *mask.shape))
    slopes[0][window] = 0.5 * (right[1:] + right[:-1])
    slopes[1][window] = -0.5 * (down[:, 1:] + down[:, :-1])
    depth = np.zeros(mask.shape)
    depth[window] = 0.25 * pitch * (z[1:, 1:] + z[1:, :-1] + z[:-1, 1:] + z[:-1, :-1])
    facts |= {"light": [round(float(v), 3) for v in light.way], "light_fit": round(light.fit, 3)}
    return np.where(mask, depth - depth[mask].max(), 0.0), normals_of(slopes * mask, mask)
