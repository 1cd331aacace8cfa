"""How a picture is lit, and in what it is carved."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.shading import light_at
from relieffab.picture.texture import Texture


@dataclass(frozen=True)
class Lit:
    """A key light and a texture.

    Parameters
    ----------
    azimuth, elevation : float
        Of the light, degrees: clockwise from the panel's far side, and above it.
    texture : {'stone', 'wood'}
    """

    azimuth: float = 315.0
    elevation: float = 32.5
    texture: Texture = "stone"

    @property
    def light(self) -> NDArray[np.float64]:
        """Unit vector towards the light."""
        return light_at(self.azimuth, self.elevation)
