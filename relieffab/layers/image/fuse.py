"""A normal map and a depth map of one figure: fine form from the one, large form from the other.

Nehab, Rusinkiewicz, Davis and Ramamoorthi, "Efficiently combining positions and
normals for precise 3D geometry" (2005), on a grid: the depth is sought whose steps are
those of the normals, and which stays near the depth map.  To this are added the steps
from one part of the figure to another behind it, which normals do not know.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.image.integrate import steps_between
from relieffab.layers.image.normalmap import slopes_in
from relieffab.layers.occlusion import STEEPEST, beside

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

LENGTH = 4.0
"""Forms wider than so many pixels follow the depth map."""
ODD = (0.2, 0.25)
"""Slope by which a depth map may be off the normals before it steps, and more by their slope."""
BLUR = 3
"""Pixels over which a step may be smeared, either way: it is one where it is steepest."""
LITTLE = 0.03
"""Trust in a depth map beside a step, and where it knows nothing."""
MOST = 1000
"""Iterations of conjugate gradients, which take some 50."""


def fuse(
    depth: Floats, known: Bools, normals: Floats, mask: Bools, pitch: float, *, doubt: float = 0.0
) -> Floats:
    """Find the depth that has the normals' form and the depth map's steps.

    Parameters
    ----------
    depth : (rows, cols) ndarray
        mm, larger is nearer; any value where it is not known.
    known : (rows, cols) ndarray of bool
        Where the depth map knows something, of the figure.
    normals : (rows, cols, 3) ndarray
        Unit vectors that face the viewer.
    mask : (rows, cols) ndarray of bool
        The figure.
    pitch : float
        mm.
    doubt : float
        By how much the depth map was rounded, mm.

    Returns
    -------
    (rows, cols) ndarray
        mm, the nearest point at 0; 0 outside the figure.
    """
    slopes = slopes_in(normals, mask)
    wanted, both, sure = steps_between(slopes, mask, pitch), _both(mask), _both(known)
    steep = np.minimum(np.hypot(*slopes), STEEPEST)
    off = [np.abs(np.diff(depth, axis=k) - want) for k, want in zip((1, 0), wanted, strict=True)]
    noise = 1.5 * float(np.median(np.concatenate([o[s] for o, s in zip(off, sure, strict=True)])))
    spare = [
        pitch * (ODD[0] + ODD[1] * np.maximum(*_ends(steep, k))) + doubt + 3.0 * noise
        for k in (1, 0)
    ]
    # Where the map is farther off than its noise and rounding explain it steps, or is smeared by
    # a step: that is where it is off most and the normals turn most.
    odd = [s & (o > most) for s, o, most in zip(sure, off, spare, strict=True)]
    cut = [
        step & _peak(much * (0.1 + _turn(normals, k)), k)
        for step, much, k in zip(odd, off, (1, 0), strict=True)
    ]
    trust = np.where(known & ~beside(odd[0], odd[1]), 1.0, LITTLE) / LENGTH**2
    weights = [np.where(b & ~c, 1.0, 0.0) for b, c in zip(both, cut, strict=True)]
    start = np.where(mask, _filled(depth, known), 0.0)
    found = _solve(start, trust, wanted, weights, mask)
    # What still contradicts the normals are steps that were not found: links hold them less.
    weights = [
        weight / (1.0 + ((np.diff(found, axis=k) - want) / most) ** 2) ** 2
        for k, weight, want, most in zip((1, 0), weights, wanted, spare, strict=True)
    ]
    found = _solve(start, trust, wanted, weights, mask)
    return np.where(mask, found - found[mask].max(), 0.0)


def _ends(field: NDArray[Any], axis: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """Values before and after each step across (1) or down (0)."""
    return (field[:, :-1], field[:, 1:]) if axis else (field[:-1], field[1:])


def _both(mask: Bools) -> tuple[Bools, Bools]:
    """Say of each step, across and down, whether both its ends are in a mask."""
    return mask[:, :-1] & mask[:, 1:], mask[:-1] & mask[1:]


def _turn(normals: Floats, axis: int) -> Floats:
    """Angle between the normals on both ends of each step, radians."""
    before, after = _ends(normals, axis)
    return np.asarray(np.arccos(np.clip((before * after).sum(axis=2), -1.0, 1.0)))


def _peak(much: Floats, axis: int) -> Bools:
    return np.asarray(much >= ndimage.maximum_filter1d(much, 2 * BLUR + 1, axis=axis), bool)


def _filled(depth: Floats, known: Bools) -> Floats:
    """Fill what is not known with the nearest that is."""
    nearest = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    return np.asarray(depth[tuple(nearest)])


def _solve(
    near: Floats, trust: Floats, wanted: tuple[Floats, Floats], weights: list[Floats], mask: Bools
) -> Floats:
    """Minimise sum w (z_j - z_i - step)² + sum trust (z - near)² by conjugate gradients."""
    from scipy import sparse
    from scipy.sparse.linalg import cg

    count = int(mask.sum())
    number = np.full(mask.shape, -1)
    number[mask] = np.arange(count)
    first, second = (
        np.concatenate([_ends(number, k)[end][w > 0] for k, w in zip((1, 0), weights, strict=True)])
        for end in (0, 1)
    )
    weight = np.concatenate([w[w > 0] for w in weights])
    asked = weight * np.concatenate([s[w > 0] for s, w in zip(wanted, weights, strict=True)])
    own = trust[mask]
    rhs = np.bincount(second, asked, count) - np.bincount(first, asked, count) + own * near[mask]
    diagonal = np.bincount(first, weight, count) + np.bincount(second, weight, count) + own
    every = np.arange(count)
    matrix = sparse.coo_array(
        (
            np.concatenate([-weight, -weight, diagonal]),
            (np.concatenate([first, second, every]), np.concatenate([second, first, every])),
        ),
        shape=(count, count),
    ).tocsr()
    start, ease = near[mask], sparse.diags_array(1.0 / diagonal)
    out = np.zeros(mask.shape)
    # Iterations that run out leave an error far below the depth map's own: no status is asked.
    out[mask] = cg(matrix, rhs, x0=start, rtol=1e-5, maxiter=MOST, M=ease)[0]
    return out
