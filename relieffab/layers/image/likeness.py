"""How unlike its photograph a surface is, and how bent: an energy and its slope.

The surface is its depth z at the corners of the pixels, in pixels, so that whatever it
is, it is a surface.  A pixel's slopes p and q come from its four corners, its normal is
n = (-p, -q, 1) / sqrt(1 + p² + q²), and what is summed over the figure's pixels is

    s² log(1 + (I - max(0, n.l))² / 2 s²) + f (1 - n_z) + b sum |n - n'|²

the photograph's brightness I against Lambert's law by a loss that grows slowly where the
two cannot agree (Lorentz's; Black and Anandan 1996), a leaning towards the viewer, and
how much the normal n' of each neighbour differs.  The last two are after the priors of
shape of Barron and Malik, "Shape, illumination, and reflectance from shading" (2015),
isotropy and smoothness; on normals, a cliff costs no more than two quarter turns.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SPREAD = 0.1
"""Difference in brightness from which the loss grows slowly, of the brightest (s)."""
DIM = 0.1
"""Brightness, of the brightest, from which a pixel that faces away is certainly wrong."""


@dataclass(frozen=True, eq=False)
class Photograph:
    """What a surface has to look like.

    Parameters
    ----------
    shade : (rows, cols) ndarray
        Brightness as n.l, 0 to about 1.
    mask : (rows, cols) ndarray of bool
        The figure.
    way : (3,) ndarray
        Unit vector towards the light.
    facing : float
        Weight of 1 - n_z (f).
    bend : float
        Weight of differences between neighbouring normals (b).
    """

    shade: Floats
    mask: Bools
    way: Floats
    facing: float
    bend: float


def energy_of(z: Floats, photograph: Photograph) -> tuple[float, Floats]:
    """Compare a surface with a photograph.

    Parameters
    ----------
    z : (rows + 1, cols + 1) ndarray
        Depth at the pixels' corners, larger is nearer, pixels.
    photograph : Photograph

    Returns
    -------
    energy : float
    slope : (rows + 1, cols + 1) ndarray
        Of the energy, by every corner's depth.
    """
    mask = photograph.mask
    normals, pull = np.zeros((*mask.shape, 3)), np.zeros((*mask.shape, 3))
    _tilt(z, mask, normals)
    total = _compare(
        normals, photograph.shade, mask, photograph.way, photograph.facing, pull
    ) + _bend(normals, mask, photograph.bend, pull)
    slope = np.zeros(z.shape)
    _gather(normals, mask, pull, slope)
    return total, slope


@kernel
def _tilt(z: Floats, mask: Bools, normals: Floats) -> None:
    """Find the normals of the figure's pixels."""
    for i in range(mask.shape[0]):
        for j in range(mask.shape[1]):
            if mask[i, j]:
                falling, rising = z[i + 1, j + 1] - z[i, j], z[i, j + 1] - z[i + 1, j]
                p, q = 0.5 * (rising + falling), 0.5 * (rising - falling)
                level = 1.0 / np.sqrt(1.0 + p * p + q * q)
                normals[i, j, 0], normals[i, j, 1], normals[i, j, 2] = -p * level, -q * level, level


@kernel
def _compare(
    normals: Floats, shade: Floats, mask: Bools, way: Floats, facing: float, pull: Floats
) -> float:
    """Sum the loss and the leaning; their slopes by each normal go to `pull`.

    In the light's shadow nothing changes with the normal; a bright pixel there is
    judged as if brightness went on below 0, or nothing would turn it to the light.
    """
    total = 0.0
    for i in range(mask.shape[0]):
        for j in range(mask.shape[1]):
            if mask[i, j]:
                n, g = normals[i, j], pull[i, j]
                cosine = n[0] * way[0] + n[1] * way[1] + n[2] * way[2]
                share = 1.0 if cosine > 0.0 else min(max(shade[i, j] / DIM, 0.0), 1.0)
                off = shade[i, j] - share * cosine
                odd = 0.5 * (off / SPREAD) ** 2
                total += SPREAD * SPREAD * np.log1p(odd) + facing * (1.0 - n[2])
                push = -off / (1.0 + odd) * share
                for k in range(3):
                    g[k] = push * way[k]
                g[2] -= facing
    return total


@kernel
def _bend(normals: Floats, mask: Bools, weight: float, pull: Floats) -> float:
    """Sum how much neighbours differ; adds the slopes by each normal to `pull`."""
    total = 0.0
    rows, cols = mask.shape
    for i in range(rows):
        for j in range(cols):
            if not mask[i, j]:
                continue
            for a, b in ((i, j + 1), (i + 1, j)):
                if a < rows and b < cols and mask[a, b]:
                    for k in range(3):
                        turn = normals[a, b, k] - normals[i, j, k]
                        total += weight * turn * turn
                        pull[a, b, k] += 2.0 * weight * turn
                        pull[i, j, k] -= 2.0 * weight * turn
    return total


@kernel
def _gather(normals: Floats, mask: Bools, pull: Floats, slope: Floats) -> None:
    """Turn slopes by normals into slopes by the corners' depths.

    dn/dp = level (n n_x - e_x), and alike for q; each corner has a half of both.
    """
    for i in range(mask.shape[0]):
        for j in range(mask.shape[1]):
            if mask[i, j]:
                n, g = normals[i, j], pull[i, j]
                along = n[0] * g[0] + n[1] * g[1] + n[2] * g[2]
                p = 0.5 * n[2] * (n[0] * along - g[0])
                q = 0.5 * n[2] * (n[1] * along - g[1])
                slope[i, j] += q - p
                slope[i, j + 1] += p + q
                slope[i + 1, j] -= p + q
                slope[i + 1, j + 1] += p - q
