"""Bend: a flat relief wrapped round an axis that lies along its Y, and unwrapped again."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Bend:
    """How a panel's face becomes part of a cylinder.

    What lies at X, Y and a height on the flat panel lies at radius + height and the
    angle (X - middle) / radius on the bent one: lengths on the face stay as they are.

    Parameters
    ----------
    radius : float
        Of the face, mm.
    middle : float
        X of the flat panel that comes to face upwards, mm.
    """

    radius: float
    middle: float

    @property
    def around(self) -> float:
        """All the way round the face, mm."""
        return 2 * np.pi * self.radius

    def bent(self, points: ArrayLike) -> Floats:
        """Wrap points of the flat panel; the axis comes to lie along Y, through X0 Z0.

        Parameters
        ----------
        points : (n, 3) array_like
            X, Y and height above the face, mm.

        Examples
        --------
        >>> Bend(40, 60).bent([[60, 10, -2]]).tolist()
        [[0.0, 10.0, 38.0]]
        """
        x, y, height = np.asarray(points, float).T
        angle = (x - self.middle) / self.radius
        away = self.radius + height
        return np.stack([away * np.sin(angle), y, away * np.cos(angle)], axis=1)

    def flat(self, points: ArrayLike) -> Floats:
        """Unwrap points, the inverse of `bent`: X within half a turn of the middle.

        Parameters
        ----------
        points : (n, 3) array_like
            mm.

        Examples
        --------
        >>> Bend(40, 60).flat([[0, 10, 38]]).tolist()
        [[60.0, 10.0, -2.0]]
        """
        x, y, z = np.asarray(points, float).T
        along = self.middle + np.arctan2(x, z) * self.radius
        return np.stack([along, y, np.hypot(x, z) - self.radius], axis=1)
