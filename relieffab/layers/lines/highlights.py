"""Highlights: where light from the eye would be brightest, the suggestive contours' bright twins.

D. DeCarlo and S. Rusinkiewicz, "Highlight lines for conveying shape", NPAR 2007.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.contours import along_radial, fading, radial_derivative
from relieffab.layers.lines.slopes import slope_of_directed
from relieffab.layers.lines.surface import Surface
from relieffab.layers.lines.zeros import zero_set

Floats = NDArray[np.float64]

LEAST_SUGGESTIVE = 0.02
"""Fall of the radial curvature, in n.v/fs^2, worth a line (Rusinkiewicz's program)."""
LEAST_PRINCIPAL = 0.04
"""Fall of the slope of n.v along e1, in 1/fs^2, worth a line (the same)."""


def suggestive_highlights(surface: Surface) -> Chains:
    """n.v is largest towards the eye: kr = 0, falling towards it (sec. 3.1)."""
    return along_radial(surface, -radial_derivative(surface), LEAST_SUGGESTIVE)


def principal_highlights(surface: Surface) -> Chains:
    """n.v is largest along e1, the direction of most bending: v.e1 = 0 (sec. 3.2)."""
    e1 = surface.bend.directions[0]
    u, _ = surface.in_principal_frame()
    # Moving along e1 turns the normal by k1 e1, so n.v grows by k1 u.
    growth = surface.bend.principal[0] * u
    fall = -slope_of_directed(surface, growth, e1) * surface.size**2

    def strength(carried: Floats) -> Floats:
        facing, fall = carried
        # Seen from inside, n.v changes its sign, and so does its fall.
        return surface.may_show(facing) * fading(np.sign(facing) * fall, LEAST_PRINCIPAL)

    return zero_set(surface, u, np.stack([surface.facing, fall]), strength, along=e1)
