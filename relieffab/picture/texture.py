"""What a relief is carved in, for its pictures: limestone, or wood with its rings."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Texture = Literal["stone", "wood"]

# Linear colours, red, green, blue: a warm limestone; early and late wood of a fruit tree.
STONE = (0.82, 0.67, 0.47)
EARLY, LATE = (0.74, 0.44, 0.22), (0.44, 0.20, 0.08)
SEED = 7  # of the one board that all pictures in wood are cut from

RING = 3.0  # mm of growth a year, in the middle
BELOW, BESIDE = 34.0, 0.38
"""Where the pith runs: mm under the face, and as a share of the board's height from near."""
SWAY, DRIFT = 3.0, 0.9  # mm by which rings wander along the board, and across it
PORES = 0.10  # share of the light they take


def plain_colour(texture: Texture) -> Floats:
    """Give the colour of a texture far off, linear red, green and blue."""
    if texture == "stone":
        return np.asarray(STONE)
    return 0.8 * np.asarray(EARLY) + 0.2 * np.asarray(LATE)


def colour_of(texture: Texture, heights: Singles, pitch: float) -> Floats:
    """Colour a carved surface.

    Parameters
    ----------
    texture : {'stone', 'wood'}
    heights : (rows, cols) ndarray
        At pixel centres, mm; wood is cut through, so its rings follow them.
    pitch : float
        Side of a pixel, mm.

    Returns
    -------
    (3,) or (rows, cols, 3) ndarray
        Linear red, green and blue.
    """
    return plain_colour(texture) if texture == "stone" else _wood(heights, pitch)


def _noise(
    shape: tuple[int, int], pitch: float, size: tuple[float, float], rng: np.random.Generator
) -> Singles:
    """Make smooth noise of deviation 1 that varies over so many mm along Y and X."""
    # On a lattice of half that size, whatever the pixels: the board stays the same.
    rows, cols = (
        max(4, int(np.ceil(count * pitch / (0.5 * mm))) + 4)
        for count, mm in zip(shape, size, strict=True)
    )
    coarse = rng.standard_normal((rows, cols))
    i, j = (
        1.5 + (np.arange(count) + 0.5) * pitch / (0.5 * mm)
        for count, mm in zip(shape, size, strict=True)
    )
    at = np.meshgrid(i, j, indexing="ij", sparse=False)
    smooth = ndimage.map_coordinates(coarse, at, order=3, mode="nearest")
    return np.asarray(smooth, np.float32)


def _wood(heights: Singles, pitch: float) -> Floats:
    """Cut a board out of a trunk: rings about a pith that runs along X below the face."""
    rng = np.random.default_rng(SEED)
    shape = heights.shape
    tall = shape[0] * pitch
    y = (tall - (np.arange(shape[0]) + 0.5) * pitch)[:, None] - BESIDE * tall
    # The trunk is no cylinder: rings sway along the board, and drift between each other.
    y = y + SWAY * _noise(shape, pitch, (80.0, 150.0), rng)
    z = heights + BELOW + SWAY * _noise(shape, pitch, (110.0, 190.0), rng)
    radius = np.hypot(y, z) + DRIFT * _noise(shape, pitch, (16.0, 120.0), rng)
    late = _late(radius)
    fibres = _noise(shape, pitch, (0.35, 9.0), rng) + 0.6 * _noise(shape, pitch, (1.1, 25.0), rng)
    share = np.clip(late + 0.05 * fibres, 0, 1)[..., None]
    colour = np.asarray(EARLY) + share * (np.asarray(LATE) - np.asarray(EARLY))
    pores = np.clip(_noise(shape, pitch, (0.22, 2.2), rng) - 1.3, 0, 1)
    broad = 1 + 0.05 * _noise(shape, pitch, (40.0, 60.0), rng)
    return np.asarray(np.clip(colour * (broad * (1 - PORES * pores))[..., None], 0.02, 1))


def _late(radius: Floats) -> Floats:
    """Tell how late in its year wood grew, 0 to 1: slowly darker, then all at once light."""
    years = radius / RING
    # Years differ: their ends lie where a slow wave puts them.
    years = years + 0.25 * np.sin(1.7 * years) + 0.15 * np.sin(0.63 * years + 1.0)
    share = years % 1.0
    rise = share**2.2
    return np.asarray(0.5 * rise * np.clip((1 - share) / 0.08, 0, 1))
