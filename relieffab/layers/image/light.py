"""Where the light of a photograph comes from, told by a body of known normals."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

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
        """What a brightness says of n.l, 0 to 1."""
        return np.clip((grey - self.ambient) / self.strength, 0.0, 1.0)


FRONT = np.array([0.0, 0.0, 1.0])


def find_light(grey: Floats, normals: Floats, mask: Bools) -> Light:
    """Fit grey = ambient + strength max(0, n.l) by least squares on lit pixels.

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
        way = way * [1.0, 1.0, 1.0] if way[2] > 0.15 else np.append(way[:2], 0.15)
        way, strength = way / np.linalg.norm(way), size
        ambient = float(np.clip(found[3], 0.0, 0.5 * g.max()))
        lit = (n @ way > 0.05) & (g > DULL)
    shown = ambient + strength * np.maximum(n @ way, 0.0)
    spread = float(((g - g.mean()) ** 2).sum())
    # The scale is the picture's own: what faces the light is nearly its brightest.
    strength = max(float(np.percentile(g, 99.5)) - ambient, 1e-6)
    left = float(((g - shown) ** 2).sum())
    return Light(way, strength, ambient, max(0.0, 1.0 - left / max(spread, 1e-12)))
