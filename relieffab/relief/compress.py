"""What the relief is asked for: slopes made small enough to fit the depth."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.model import Layers

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SPECK = 1.5  # mm: shorter tears without a line are folds of the mesh, and no occlusions
INK = 0.02  # from which there is a line


def compress(v: Floats) -> Floats:
    """Bound slopes: G(v) = v / sqrt(1 + |v|²), the tangential part of the normal.

    Gentle slopes are kept, none comes out steeper than 1.  Multiplied by a small
    gain these are the slopes of a low relief whose radiance goes with the model's
    normals (1 - n_z apart), which a power of the slopes (Wang 2011, Eq. 10) is not.

    Parameters
    ----------
    v : (2, rows, cols) ndarray
        Slopes.

    Returns
    -------
    (2, rows, cols) ndarray
    """
    return v / np.sqrt(1.0 + v[0] ** 2 + v[1] ** 2)


def without_specks(layers: Layers, torn: Bools) -> Bools:
    """Leave out tears that are neither long nor drawn.

    A fold of the mesh a pixel or two wide jumps as an occlusion does; parted there,
    the surface would show a tick for it.

    Parameters
    ----------
    layers : Layers
    torn : (rows, cols) ndarray of bool
        From `beside`.

    Returns
    -------
    (rows, cols) ndarray of bool
        Pixels of connected tears that are at least `SPECK` long or wide, or that a
        line touches.
    """
    tears, _ = ndimage.label(torn, np.ones((3, 3)))
    sizes = [max(s.stop - s.start for s in box) for box in ndimage.find_objects(tears)]
    keep = np.array([0, *sizes]) * layers.pitch >= SPECK
    keep[tears[layers.lines > INK]] = True
    keep[0] = False
    return keep[tears]


def form(layers: Layers, span: tuple[float, float], *, evenness: float = 0.75) -> Floats:
    """Compress the depth range monotonically, so that the depth order stays whole.

    A quarter linear (Cignoni 1997), three quarters equalised: a far limb does not
    take the room of the forms in front of it.

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
