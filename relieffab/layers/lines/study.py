"""Study: a mesh with all that can be drawn of it, from any side."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.creases import find_creases
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.edges import Edges, find_edges
from relieffab.layers.lines.kinds import Kind
from relieffab.layers.lines.surface import Surface, prepare
from relieffab.layers.lines.zeros import edge_lines
from relieffab.layers.shading import face_normals
from relieffab.layers.view import Placed

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

ALIKE = 1.05
"""Ratio of lengths that make no difference to be seen."""


@dataclass(frozen=True, eq=False)
class Study:
    """A mesh as it is placed, with all its lines, seen or not.

    Parameters
    ----------
    placed : Placed
    edges : Edges
        Of its faces.
    creases : (e,) ndarray of bool
        Edges that are creases.
    surface : Surface
        Parted at them, and faired.
    lengths : tuple of float
        Detail and shortest line that it was made for, mm.
    """

    placed: Placed
    edges: Edges
    creases: Flags
    surface: Surface
    lengths: tuple[float, float]

    @classmethod
    def of(cls, placed: Placed, drawing: Drawing, *, edges: Edges | None = None) -> "Study":
        """Study a mesh for the detail and the shortest line of a drawing.

        Parameters
        ----------
        placed : Placed
        drawing : Drawing
        edges : Edges, optional
            Of the mesh's faces, if at hand.
        """
        edges = edges or find_edges(placed.faces, len(placed.solid))
        creases = find_creases(placed.solid, placed.faces, edges, drawing.min_length)
        surface = prepare(
            placed.solid, placed.faces, creases, edges, detail=drawing.detail, eye=placed.eye
        )
        return cls(placed, edges, creases, surface, (drawing.detail, drawing.min_length))

    def serves(self, placed: Placed, drawing: Drawing) -> bool:
        """Tell whether it will do for another view: its lengths scale with the model."""
        scale = _scale(self._motion(placed))
        asked = drawing.detail, drawing.min_length
        return all(
            scale * mine <= ALIKE * other and other <= ALIKE * scale * mine
            for mine, other in zip(self.lengths, asked, strict=True)
        )

    def seen(self, placed: Placed) -> "Study":
        """Turn to another view of the same model: how it bends does not depend on who looks."""
        motion = self._motion(placed)
        scale = _scale(motion)
        return replace(
            self,
            placed=placed,
            surface=self.surface.moved(motion, scale, placed.eye),
            lengths=(scale * self.lengths[0], scale * self.lengths[1]),
        )

    def _motion(self, placed: Placed) -> Floats:
        """From the model's true shape as it lies here to where it lies there, (4, 4)."""
        there, here = (np.linalg.solve(p.eye.matrix, p.matrix) for p in (placed, self.placed))
        return np.asarray(there @ np.linalg.inv(here), np.float64)

    def lines(self, kind: Kind) -> Chains:
        """Find all lines of a kind."""
        if kind.of_surface is not None:
            return kind.of_surface(self.surface)
        here = self.creases if kind.name == "crease" else self.edges.faces[:, 1] < 0
        sides = self.edges.faces[here]
        seen = face_normals(self.placed.vertices, self.placed.faces[sides.ravel()])
        sine = np.hypot(seen[:, 0], seen[:, 1]) / np.maximum(np.linalg.norm(seen, axis=1), 1e-300)
        gentler = sine.reshape(-1, 2).min(axis=1)
        return edge_lines(self.placed.vertices, self.edges.ends[here], gentler)


def _scale(motion: Floats) -> float:
    return float(np.cbrt(np.linalg.det(motion[:3, :3])))
