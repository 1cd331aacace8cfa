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
EVEN = 0.15
"""How much the rim's brightness goes with where it faces, of the brightest, under a light from
the front at most, if nothing lies in shadow."""
SHADOW = 0.02
"""Of the figure: as many pixels that are equally dark are in shadow."""
ALIKE = 0.03
"""Spread of their brightness, of the brightest."""


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
"""Fit below which the figure is no such body."""
RIM = 3
"""Pixels along the outline that bend away from the viewer on any figure."""
LOWEST = 0.15
"""Sine of the least elevation of a light."""
FRONT = np.array([0.0, 0.0, 1.0])


def find_light(grey: Floats, normals: Floats, mask: Bools) -> Light:
    """Find the light under which a figure shows its brightness.

    Its direction across the picture is told by the figure's rim, which bends away
    outward whatever the figure is (Nillius and Eklundh 2001); its elevation by the
    least squares fit of grey = ambient + strength max(0, n.l) to a body that is about
    the one shown, and, as far as that leaves the brightness unexplained, by its median,
    about that of what faces the viewer, or by that alone where the figure is rather
    flat. Under a light from the front the rim is as bright all round, and nothing lies
    in shadow. What shadows tell of the even light goes before what the body does.

    Parameters
    ----------
    grey : (rows, cols) ndarray
        Brightness, 0 to about 1.
    normals : (rows, cols, 3) ndarray
        Of that body.
    mask : (rows, cols) ndarray of bool
        The figure.

    Returns
    -------
    Light
        From the front where the rim's brightness follows no other.
    """
    brightest = max(float(np.percentile(grey[mask], 99.5)), 1e-6)
    way, ambient, fit = _of_body(grey[mask], normals[mask])
    tilt = _of_rim(grey, mask)
    size = float(np.hypot(*tilt))
    level = float(np.clip(np.median(grey[mask]) / brightest, LOWEST, 1.0))
    if fit < ROUND:
        ambient = 0.0
    else:
        level += fit * (float(way[2]) - level)
    dark, shadow = np.percentile(grey[mask], [25.0 * SHADOW, 100.0 * SHADOW])
    shadowed = bool(shadow - dark < ALIKE * brightest and shadow < 0.5 * brightest)
    if shadowed:
        ambient = float(shadow)
    if size > (DULL if shadowed else EVEN) * brightest:
        way = np.append(tilt / size * np.sqrt(1.0 - level**2), level)
    else:
        way = FRONT
    # The scale is the picture's own: what faces the light is nearly its brightest.
    return Light(way, max(brightest - ambient, 1e-6), ambient, fit)


def _of_body(grey: Floats, normals: Floats) -> tuple[Floats, float, float]:
    """Fit one light and an even one to a body's lit pixels: way, ambient, and how well."""
    bright = grey > DULL * grey.max()
    lit = bright
    way, strength, ambient = FRONT, 1.0, 0.0
    for _ in range(ROUNDS):
        if lit.sum() < 16:
            break
        table = np.column_stack([normals[lit], np.ones(int(lit.sum()))])
        found = np.linalg.lstsq(table, grey[lit], rcond=None)[0]
        strength = float(np.linalg.norm(found[:3]))
        if strength < 1e-6:
            break
        # No light is seen from behind: the figure would be dark.
        way = np.append(found[:2], max(found[2], LOWEST * strength))
        way = way / np.linalg.norm(way)
        ambient = float(np.clip(found[3], 0.0, 0.5 * grey.max()))
        lit = (normals @ way > 0.05) & bright
    shown = ambient + strength * np.maximum(normals @ way, 0.0)
    spread = float(((grey - grey.mean()) ** 2).sum())
    left = float(((grey - shown) ** 2).sum())
    return way, ambient, max(0.0, 1.0 - left / max(spread, 1e-12))


def _of_rim(grey: Floats, mask: Bools) -> Floats:
    """Tell how the brightness of the rim goes with the way it faces, X and Y."""
    inward = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    down, right = np.gradient(ndimage.gaussian_filter(inward, 1.0))
    rim = mask & (inward <= RIM) & (grey > DULL * grey[mask].max())
    outward = np.column_stack([-right[rim], down[rim]])
    if len(outward) < 3:
        return np.zeros(2)
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-9)
    table = np.column_stack([outward, np.ones(len(outward))])
    return np.asarray(np.linalg.lstsq(table, grey[rim], rcond=None)[0][:2])
