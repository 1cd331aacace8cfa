"""Where the light of a photograph comes from, told by a body of known normals."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

ROUNDS = 8
DULL = 0.02
"""Brightness, of the brightest, up to which a pixel is in shadow and tells nothing."""


@dataclass(frozen=True, eq=False)
class Light:
    """One distant light and an even one.

    Parameters
    ----------
    way : (3,) ndarray
        Unit vector towards it.
    strength : float
        Brightness it adds to a surface that faces it.
    ambient : float
        Brightness of what it does not reach.
    fit : float
        Share of the brightness's variance that they explain, 0 to 1.
    """

    way: Floats
    strength: float
    ambient: float
    fit: float

    def cosine(self, grey: Floats) -> Floats:
        """Say what n.l a brightness stands for, 0 to 1."""
        return np.clip((grey - self.ambient) / self.strength, 0.0, 1.0)


ROUND = 0.3
"""Fit below which the figure is no such body, and its rim alone is asked."""
RIM = 3
"""Pixels along the outline that bend away from the viewer on any figure."""
FRONT = np.array([0.0, 0.0, 1.0])


def find_light(grey: Floats, normals: Floats, mask: Bools) -> Light:
    """Fit grey = ambient + strength max(0, n.l) by least squares on lit pixels.

    Where that explains little, the figure being rather flat, its rim tells the
    direction, since it bends away outward (Nillius and Eklundh 2001), and the
    median brightness, of what faces the viewer, the elevation.

    Parameters
    ----------
    grey : (rows, cols) ndarray
        Brightness, 0 to about 1.
    normals : (rows, cols, 3) ndarray
        Of a body that is about the one shown.
    mask : (rows, cols) ndarray of bool

    Returns
    -------
    Light
        From the front where the brightness follows no light.
    """
    n, g = normals[mask], grey[mask]
    lit = g > DULL
    way, strength, ambient = FRONT, max(float(np.percentile(g, 99)), 1e-6), 0.0
    for _ in range(ROUNDS):
        if lit.sum() < 16:
            break
        table = np.column_stack([n[lit], np.ones(int(lit.sum()))])
        found = np.linalg.lstsq(table, g[lit], rcond=None)[0]
        size = float(np.linalg.norm(found[:3]))
        if size < 1e-6:
            break
        # No light is seen from behind: the figure would be dark.
        way = found[:3] / size
        way = way if way[2] > 0.15 else np.append(way[:2], 0.15)
        way, strength = way / np.linalg.norm(way), size
        ambient = float(np.clip(found[3], 0.0, 0.5 * g.max()))
        lit = (n @ way > 0.05) & (g > DULL)
    shown = ambient + strength * np.maximum(n @ way, 0.0)
    spread = float(((g - g.mean()) ** 2).sum())
    # The scale is the picture's own: what faces the light is nearly its brightest.
    strength = max(float(np.percentile(g, 99.5)) - ambient, 1e-6)
    left = float(((g - shown) ** 2).sum())
    fit = max(0.0, 1.0 - left / max(spread, 1e-12))
    return Light(way, strength, ambient, fit) if fit >= ROUND else _of_rim(grey, mask, fit)


def _of_rim(grey: Floats, mask: Bools, fit: float) -> Light:
    inward = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    down, right = np.gradient(ndimage.gaussian_filter(inward, 1.0))
    rim = mask & (inward <= RIM)
    brightest = max(float(np.percentile(grey[mask], 99.5)), 1e-6)
    table = np.column_stack([-right[rim], down[rim], np.ones(int(rim.sum()))])
    across = np.linalg.norm(table[:, :2], axis=1, keepdims=True)
    table[:, :2] /= np.maximum(across, 1e-9)
    tilt = np.linalg.lstsq(table, grey[rim], rcond=None)[0][:2]
    size = float(np.hypot(*tilt))
    level = float(np.clip(np.median(grey[mask]) / brightest, 0.15, 1.0))
    if size < DULL * brightest:
        return Light(FRONT, brightest, 0.0, fit)
    way = np.append(np.sqrt(1.0 - level**2) * tilt / size, level)
    return Light(way, brightest, 0.0, fit)
