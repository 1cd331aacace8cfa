"""Shape from the shading of one photograph.

Every pixel's normal must lie on a cone about the light whose opening its brightness
tells (Worthington and Hancock 1999); slopes must be a surface's (Frankot and
Chellappa 1988); and wide forms follow a reference, here the body that the outline
suggests, as a relief's wide forms follow its compressed depth.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from skimage.transform import resize

from relieffab.layers.image.inflate import inflate
from relieffab.layers.image.integrate import integrate
from relieffab.layers.image.light import ROUND, Light, find_light
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.steps import normals_of, slopes_of

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

WORKING = 192
"""Pixels each way at most while the form is sought; finer ones only add detail."""
ROUNDS = 20
"""Of cones and surfaces in turn while it is."""
FINER = 3
"""The same, on the panel's own pixels."""
LENGTH = 0.4
"""Of the figure's longer side: wider forms follow the reference."""
THICK = 0.6
"""Of a round body's thickness: few figures are as thick as they are wide."""
FLAT = 0.1
"""The same, where the shading says that the figure is no such body."""
DETAIL = 0.1
"""Of that length: wider forms are settled when the panel's own pixels are come to."""
ROUGHLY = 3e-3
"""Tolerance of each integration: the next one sets right what it leaves."""
CALM = 1.0
"""Deviation of the Gaussian over normals between rounds, pixels."""


def brightness(picture: Picture) -> Floats:
    """Brightness in linear light, 0 to 1: 8-bit pictures are sRGB, finer ones linear."""
    grey = np.nan_to_num(picture.grey)
    if picture.bits is not None and picture.bits <= 8:
        return np.where(grey <= 0.04045, grey / 12.92, ((grey + 0.055) / 1.055) ** 2.4)
    return grey


def on_cone(normals: Floats, cosine: Floats, way: Floats) -> Floats:
    """Turn normals the shortest way onto cones about the light.

    Parameters
    ----------
    normals : (rows, cols, 3) ndarray
        Unit.
    cosine : (rows, cols) ndarray
        n.l asked for; where it is 0, any normal that faces away from the light will do.
    way : (3,) ndarray
        Unit vector towards the light.

    Returns
    -------
    (rows, cols, 3) ndarray
    """
    along = normals @ way
    aside = normals - along[..., None] * way
    length = np.linalg.norm(aside, axis=2, keepdims=True)
    aside = aside / np.maximum(length, 1e-9)
    turned = cosine[..., None] * way + np.sqrt(1.0 - cosine**2)[..., None] * aside
    free = (length[..., 0] < 1e-6) | ((cosine <= 0.0) & (along <= 0.0))
    return np.where(free[..., None], normals, turned)


def _slopes(normals: Floats) -> Floats:
    z = np.maximum(normals[..., 2], 0.15)
    return np.stack([-normals[..., 0] / z, -normals[..., 1] / z])


def _smooth(normals: Floats, mask: Bools, sigma: float) -> Floats:
    calm = ndimage.gaussian_filter(normals * mask[..., None], (sigma, sigma, 0))
    return calm / np.maximum(np.linalg.norm(calm, axis=2, keepdims=True), 1e-9)


def _refine(
    normals: Floats, cosine: Floats, light: Light, mask: Bools, pitch: float,
    reference: Floats, length: float, rounds: int,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Cones and surfaces in turn; the depth and its normals."""
    depth = reference
    for _ in range(rounds):
        asked = on_cone(_smooth(normals, mask, CALM), cosine, light.way)
        depth = integrate(
            _slopes(asked), mask, pitch, reference=reference, length=length, tolerance=ROUGHLY
        )
        normals = normals_of(slopes_of(depth, mask, pitch), mask)
    return depth, normals


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
    body = THICK * inflate(mask, pitch)
    shrink = max(1.0, max(mask.shape) / WORKING)
    shape = tuple(max(8, round(n / shrink)) for n in mask.shape)
    step = pitch * mask.shape[0] / shape[0]
    cover = resize(mask.astype(float), shape, order=1, anti_aliasing=True)
    there = cover > 0.5
    small = resize(np.where(mask, grey, 0.0), shape, order=1, anti_aliasing=True)
    small = np.divide(small, cover, out=np.zeros(shape), where=cover > 1e-6)
    reference = resize(body, shape, order=1, anti_aliasing=True) * there
    normals = normals_of(slopes_of(reference, there, step), there)
    light = find_light(small, normals, there)
    if light.fit < ROUND:
        body, reference = FLAT / THICK * body, FLAT / THICK * reference
        normals = normals_of(slopes_of(reference, there, step), there)
    sides = [np.ptp(np.flatnonzero(mask.any(axis=axis))) + 1 for axis in (0, 1)]
    length = LENGTH * pitch * float(max(sides))
    depth, normals = _refine(
        normals, light.cosine(small), light, there, step, reference, length, ROUNDS
    )
    wide = resize(depth, mask.shape, order=1) * mask
    start = resize(normals, (*mask.shape, 3), order=1)
    start /= np.maximum(np.linalg.norm(start, axis=2, keepdims=True), 1e-9)
    depth, normals = _refine(
        start, light.cosine(grey), light, mask, pitch, wide, DETAIL * length, FINER
    )
    facts |= {"light": [round(float(v), 3) for v in light.way], "light_fit": round(light.fit, 3)}
    return np.where(mask, depth - depth[mask].max(), 0.0), normals
