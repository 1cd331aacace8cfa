"""What the relief is asked for: slopes made small enough to fit the depth."""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

STEEPEST = 8.0  # slopes of pixels seen edge on carry no more than this


def slopes(layers: Layers) -> Floats:
    """Slopes of the model at the pixels, from its normals.

    Normals know the slope on either side of an occlusion; differences of depth
    would take the jump between them for a cliff (Wang 2011, Eqs. 9-12).

    Returns
    -------
    (2, rows, cols) ndarray
        dD/dx and dD/dy, no steeper than `STEEPEST`; 0 outside the figure.
    """
    n = layers.normals
    flat = np.maximum(n[..., 2], 1e-6)
    p = np.stack([-n[..., 0] / flat, -n[..., 1] / flat])
    steep = np.hypot(p[0], p[1])
    p *= np.minimum(1.0, STEEPEST / np.maximum(steep, 1e-12))
    return p * layers.mask


def compress(v: Floats, mask: Bools, *, exponent: float = 0.8, knee: float = 0.1) -> Floats:
    """Attenuate large slopes more than small ones.

    G(v) = v (|v|/gamma)^(exponent - 1), with gamma the knee times the mean
    slope; below gamma slopes are kept as they are (Wang 2011, Eq. 10, with the
    modulus of Fattal 2002, Eq. 5).

    Parameters
    ----------
    v : (2, rows, cols) ndarray
        Slopes.
    mask : (rows, cols) ndarray of bool
        Where the mean is taken.
    exponent : float
        1 keeps slopes, 0 makes all of them gamma.
    knee : float

    Returns
    -------
    (2, rows, cols) ndarray
    """
    size = np.hypot(v[0], v[1])
    gamma = knee * float(size[mask].mean())
    if gamma == 0.0:
        return v.copy()
    return v * np.maximum(size / gamma, 1.0) ** (exponent - 1.0)


def occlusions(layers: Layers, v: Floats) -> tuple[Bools, Bools]:
    """Find where one part of the figure stands in front of another.

    Two neighbouring pixels belong to one surface if the depth between them
    changes no more than their slopes explain, with as much again to spare.

    Parameters
    ----------
    layers : Layers
    v : (2, rows, cols) ndarray
        Slopes of the model.

    Returns
    -------
    across : (rows, cols - 1) ndarray of bool
        Jump between a pixel and its right neighbour, both in the figure.
    down : (rows - 1, cols) ndarray of bool
        Jump between a pixel and its near (lower) neighbour.
    """
    pitch = layers.pitch

    def jumps(a: tuple[slice, ...], b: tuple[slice, ...], slope: Floats) -> Bools:
        change = layers.depth[b] - layers.depth[a]
        expected = 0.5 * pitch * (slope[a] + slope[b])
        spare = pitch * (1.0 + np.maximum(np.abs(slope[a]), np.abs(slope[b])))
        inside: Bools = layers.mask[a] & layers.mask[b]
        return inside & (np.abs(change - expected) > spare)

    every = slice(None)
    across = jumps((every, slice(None, -1)), (every, slice(1, None)), v[0])
    down = jumps((slice(None, -1), every), (slice(1, None), every), -v[1])
    return across, down


def beside(across: Bools, down: Bools) -> Bools:
    """Pixels on either side of the jumps that `occlusions` finds, (rows, cols)."""
    torn = np.zeros((len(across), down.shape[1]), bool)
    torn[:, :-1] |= across
    torn[:, 1:] |= across
    torn[:-1] |= down
    torn[1:] |= down
    return torn


def steps(layers: Layers, across: Bools, down: Bools, most: float) -> Floats:
    """Slopes that keep a small step where one part stands in front of another.

    The jump between two pixels, cut to a few tenths of a millimetre, is shared
    between them: the nearer part stays nearer, and takes no room from the forms
    on either side (as Weyrich 2007, Sect. 4.1, asks for steps of a fixed size).

    Parameters
    ----------
    layers : Layers
    across, down : ndarray of bool
        From `occlusions`.
    most : float
        Highest step, mm.

    Returns
    -------
    (2, rows, cols) ndarray
        0 where there is no jump.
    """
    out = np.zeros((2, *layers.grid.shape))
    jump = np.clip(np.diff(layers.depth, axis=1), -most, most) * across / (2 * layers.pitch)
    out[0, :, :-1] += jump
    out[0, :, 1:] += jump
    jump = np.clip(-np.diff(layers.depth, axis=0), -most, most) * down / (2 * layers.pitch)
    out[1, :-1] += jump
    out[1, 1:] += jump
    return out


def form(layers: Layers, span: tuple[float, float], *, evenness: float = 0.5) -> Floats:
    """Compress the depth range monotonically, so that the depth order stays whole.

    Half linear (Cignoni 1997), half equalised: a far limb does not take the
    room of the forms in front of it.

    Parameters
    ----------
    layers : Layers
    span : tuple of float
        Heights of the farthest and the nearest point, mm.
    evenness : float
        Weight of equalisation, 0 to 1.

    Returns
    -------
    (rows, cols) ndarray
        mm; 0 outside the figure.
    """
    seen = layers.depth[layers.mask]
    low, high = float(seen.min()), float(seen.max())
    if high <= low:
        return np.where(layers.mask, span[1], 0.0)
    share, edges = np.histogram(seen, 256, (low, high))
    rank = np.concatenate([[0.0], np.cumsum(share) / share.sum()])
    nearness = (layers.depth - low) / (high - low)
    even = np.interp(layers.depth, edges, rank)
    level = (1.0 - evenness) * nearness + evenness * even
    return np.where(layers.mask, span[0] + (span[1] - span[0]) * level, 0.0)
