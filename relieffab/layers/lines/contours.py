"""Contours: where a surface turns away from the eye, or almost does.

D. DeCarlo et al., "Suggestive contours for conveying shape", SIGGRAPH 2003;
S. Rusinkiewicz et al., "Line drawings from 3D models", SIGGRAPH course 2008.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.surface import Surface
from relieffab.layers.lines.zeros import zero_set

Floats = NDArray[np.float64]

FLATTEST = 1e-3
"""Curvature towards the eye, in 1/radius, of the flattest contour: a plane seen edge on is none."""
LEAST = 0.01
"""Change of the radial curvature, in n.v/fs^2, worth a line (Rusinkiewicz's program)."""


def radial_curvature(surface: Surface) -> Floats:
    """Curvature towards the eye times sin^2 of the angle off the normal: (v,), 1/mm."""
    u, w = surface.in_principal_frame()
    k1, k2 = surface.bend.principal
    return k1 * u * u + k2 * w * w


def radial_derivative(surface: Surface) -> Floats:
    """Change of the radial curvature towards the eye, times its sine: (v,), 1/mm^2.

    The sine is of the angle between normal and view.
    """
    u, w = surface.in_principal_frame()
    k1, k2 = surface.bend.principal
    c0, c1, c2, c3 = surface.bend.derivative
    sine2 = np.maximum(u * u + w * w, 1e-12)
    along = (u * u * (u * c0 + 3 * w * c1) + w * w * (3 * u * c2 + w * c3)) / sine2
    torsion = (k2 - k1) * u * w / sine2
    return along - 2 * surface.facing * torsion**2


def fading(x: Floats, least: float) -> Floats:
    """Strength of a line from what it is measured by: 1/4 at the least worth a line."""
    x = np.maximum(x, 0.0)
    return x / (3 * least + x)


def contours(surface: Surface) -> Chains:
    """Where the surface turns away from the eye: n.v = 0, strength 1 where kr > 0.

    The inside of an open surface turns away where kr < 0; its normals are then
    turned to the side that is seen.
    """
    flattest = FLATTEST / surface.radius if surface.radius > 0 else 0.0

    def side(carried: Floats) -> Floats:
        inside = np.where(carried[0] < -flattest, -1.0, 0.0) if surface.open else 0.0
        return np.where(carried[0] > flattest, 1.0, inside)

    lines = zero_set(surface, surface.facing, radial_curvature(surface)[None], side)
    turned = np.where(lines.strength < 0, -1.0, 1.0)[:, None]
    return replace(lines, strength=np.abs(lines.strength), normals=turned * lines.normals)


def suggestive(surface: Surface) -> Chains:
    """Where it almost does: kr = 0, growing towards the eye.

    Seen from inside, n.v and the change both change their signs.
    """
    return along_radial(surface, radial_derivative(surface), LEAST)


def along_radial(surface: Surface, change: Floats, least: float) -> Chains:
    """Lines of kr = 0, as strong as a change (v,), 1/mm^2, in units of n.v/fs^2."""

    def strength(carried: Floats) -> Floats:
        facing, change = carried
        shows = surface.may_show(facing)
        return np.where(shows, fading(change / np.where(shows, facing, 1.0), least), 0.0)

    carried = np.stack([surface.facing, change * surface.size**2])
    return zero_set(surface, radial_curvature(surface), carried, strength)
