"""Feature sensitive bas-relief (Kerber, Tevs, Belyaev, Zayer, Seidel 2009).

As in the gradient domain before it, but a bilateral filter splits the slopes: it
keeps their edges, which are the model's ridges and valleys, in the coarse part,
so that the boost of the fine part leaves no halo beside them.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import parallel_kernel, prange
from relieffab.layers.model import Layers
from relieffab.relief.classic.figure import TAILS, extent, model_slopes, stretch
from relieffab.relief.classic.gradient import attenuate
from relieffab.relief.classic.integrate import integrate
from relieffab.relief.model import nodes_of
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

OUTLIER = 6.0  # slopes steeper than this belong to silhouettes and are dropped
KNEE = 0.1  # of the mean slope
EXPONENT = 0.6  # of the attenuation
BOOST = 8.0  # of the fine part
REACH = 0.008  # sigma of the filter on the panel, of the figure's extent
TOLERANCE = 1.0  # sigma of the filter on slopes, in standard deviations of them


@parallel_kernel
def _filter(v, sound, bell, width, out):  # type: ignore[no-untyped-def]
    """Mean of near pixels of like slopes; (1 - d^2/width^2)^2 stands for a Gaussian of d."""
    rows, cols = sound.shape
    reach = len(bell) // 2
    narrow = np.float32(1.0) / (width * width)
    for i in prange(rows):
        for j in range(cols):
            if not sound[i, j]:
                continue
            p, q = v[0, i, j], v[1, i, j]
            total_p = total_q = mass = np.float32(0.0)
            for a in range(max(0, i - reach), min(rows, i + reach + 1)):
                row = bell[a - i + reach]
                for b in range(max(0, j - reach), min(cols, j + reach + 1)):
                    x, y = v[0, a, b] - p, v[1, a, b] - q
                    like = max(np.float32(1.0) - narrow * (x * x + y * y), np.float32(0.0))
                    w = row[b - j + reach] * like * like * sound[a, b]
                    mass += w
                    total_p += w * x
                    total_q += w * y
            out[0, i, j], out[1, i, j] = p + total_p / mass, q + total_q / mass


def filtered(v: Floats, sound: Bools, sigma: float, tolerance: float) -> Floats:
    """Smooth a field of slopes but for its edges.

    Parameters
    ----------
    v : (2, rows, cols) ndarray
    sound : (rows, cols) ndarray of bool
        Pixels that count.
    sigma : float
        Of the neighbourhood, pixels.
    tolerance : float
        Sigma of the difference of slopes: pixels much further apart do not meet.

    Returns
    -------
    (2, rows, cols) ndarray
        0 on other pixels.
    """
    reach = max(1, round(2.0 * sigma))
    axis = np.arange(-reach, reach + 1) / max(sigma, 0.25)
    bell = np.exp(-0.5 * (axis[:, None] ** 2 + axis**2)).astype(np.float32)
    out = np.zeros(v.shape, np.float32)
    # The bell (1 - d^2/w^2)^2 has the curvature of a Gaussian at w = 2 sigma.
    width = np.float32(max(2.0 * tolerance, 1e-12))
    _filter(v.astype(np.float32), sound.astype(np.float32), bell, width, out)
    return out.astype(float)


def bilateral(layers: Layers, depth: float) -> Floats:
    """Compress the model in the gradient domain, its ridges and valleys kept.

    Parameters
    ----------
    layers : Layers
    depth : float
        mm.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        Heights, mm, -depth to 0; 0 outside the figure.
    """
    figure, place = cropped(layers)
    slope, whole = model_slopes(figure)
    sound = whole & (np.hypot(slope[0], slope[1]) < OUTLIER)
    calm = attenuate(slope, sound, knee=KNEE, exponent=EXPONENT)
    spread = float(np.sqrt(calm[:, sound].var(axis=1).mean())) if sound.any() else 0.0
    coarse = filtered(calm, sound, REACH * extent(figure) / figure.pitch, TOLERANCE * spread)
    asked = coarse + BOOST * (calm - coarse)
    heights = integrate(asked, np.ones(sound.shape), figure.mask, figure.pitch)
    relief = stretch(heights, nodes_of(figure.mask), depth, tails=TAILS)
    return place.put(relief, layers.grid.node_shape)
