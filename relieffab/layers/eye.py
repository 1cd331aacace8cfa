"""Eye: the point a model is seen from, as a map of space and as directions."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Eye:
    """A viewer above the panel, at a distance or infinitely far.

    Looking from a point is looking straight down at a model bent by a homology:
    the plane Z0 stays, depths beyond it shrink towards a limit, planes stay
    planes and what hides what stays the same.  Sculptors know it as relief
    perspective (Breysig, "Versuch einer Erläuterung der Reliefs-Perspective",
    1798).

    Parameters
    ----------
    x, y : float
        The point of the plane Z0 straight below, mm.
    nearness : float
        1 over the height above Z0, 1/mm; 0 for parallel lines of sight.
    """

    x: float = 0.0
    y: float = 0.0
    nearness: float = 0.0

    @property
    def matrix(self) -> Floats:
        """(4, 4) homogeneous, from the model's true shape to what is seen."""
        matrix = np.eye(4)
        matrix[:3, 2] -= self.nearness * np.array([self.x, self.y, 0.0])
        matrix[3, 2] = -self.nearness
        return matrix

    def project(self, points: Floats) -> Floats:
        """Bend space so that lines of sight fall straight down: (n, 3) to (n, 3), mm."""
        foot = np.array([self.x, self.y, 0.0])
        return foot + (points - foot) / (1.0 - self.nearness * points[:, 2:])

    def towards(self, points: Floats) -> Floats:
        """Return unit vectors from true points (n, 3) to the eye: (n, 3)."""
        to = self.nearness * (np.array([self.x, self.y, 0.0]) - points)
        to[:, 2] += 1.0
        return to / np.linalg.norm(to, axis=1, keepdims=True)

    def bend_normals(self, points: Floats, normals: Floats) -> Floats:
        """Return the bent surface's unit normals at true points with true normals: (n, 3)."""
        plane = np.column_stack([normals, -np.einsum("nk,nk->n", normals, points)])
        bent = (plane @ np.linalg.inv(self.matrix))[:, :3]
        return bent / np.maximum(np.linalg.norm(bent, axis=1, keepdims=True), 1e-300)
