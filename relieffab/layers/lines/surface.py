"""Surface: a mesh with all that its lines are found from."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.eye import Eye
from relieffab.layers.lines.curvature import Curvature, curvature
from relieffab.layers.lines.edges import Edges, find_edges, split_at
from relieffab.layers.lines.jets import osculate
from relieffab.layers.lines.smooth import smooth

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

FEATURE = 0.05
"""Feature size as a share of the radius.

Rusinkiewicz's program takes 0.01/P10(|k|) where that is less; but how flat the
flattest tenth of a mesh is tells more of the mesh than of the model.
"""


@dataclass(frozen=True, eq=False)
class Surface:
    """A mesh in its true shape, how it bends and how it is seen.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        On the panel, mm.
    faces : (f, 3) ndarray of int
    edges : Edges
        Of the faces.
    bend : Curvature
        Of the faired copy.
    radius : float
        Of the whole, mm.
    eye : Eye
    view : (v, 3) ndarray
        Unit vectors from the surface to the eye.
    open : bool
        Whether the mesh has a rim, so that its inside may be seen.
    """

    vertices: Floats
    faces: Ints
    edges: Edges
    bend: Curvature
    radius: float
    eye: Eye
    view: Floats
    open: bool

    @property
    def size(self) -> float:
        """Feature size, the scale of thresholds on derivatives, mm."""
        return FEATURE * self.radius

    @property
    def facing(self) -> Floats:
        """(v,) n.v, 1 where the surface faces the eye."""
        return np.einsum("vk,vk->v", self.bend.normals, self.view)

    def may_show(self, facing: Floats) -> NDArray[np.bool_]:
        """Tell from n.v whether a side that may be seen faces the eye: (n,)."""
        return facing != 0 if self.open else facing > 0

    def moved(self, motion: Floats, scale: float, eye: Eye) -> "Surface":
        """Take the surface elsewhere, turned and scaled, before another eye.

        Parameters
        ----------
        motion : (4, 4) ndarray
            Homogeneous: a rotation times the scale, and a shift, mm.
        scale : float
        eye : Eye
        """
        vertices = self.vertices @ motion[:3, :3].T + motion[:3, 3]
        return replace(
            self,
            vertices=vertices,
            bend=self.bend.moved(motion[:3, :3] / scale, scale),
            radius=scale * self.radius,
            eye=eye,
            view=eye.towards(vertices),
        )

    def in_principal_frame(self) -> tuple[Floats, Floats]:
        """Components u and w of the view along e1 and e2: (v,) each."""
        e1, e2 = self.bend.directions
        u, w = (np.einsum("vk,vk->v", e, self.view) for e in (e1, e2))
        return u, w


def prepare(
    vertices: Floats,
    faces: Ints,
    sharp: NDArray[np.bool_],
    edges: Edges,
    *,
    detail: float = 0.0,
    eye: Eye | None = None,
) -> Surface:
    """Part a mesh at its creases, fair a copy and measure how it bends.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        True shape on the panel, mm.
    faces : (f, 3) ndarray of int
    sharp : (e,) ndarray of bool
        Creases: smooth on either side, so each side is measured alone.
    edges : Edges
        Of the faces.
    detail : float
        Wavelength that keeps half its height, mm; 0 takes nothing off.
    eye : Eye, optional
        Straight above, infinitely far, if not given.
    """
    eye = eye or Eye()
    rimmed = bool((edges.faces[:, 1] < 0).any())
    if sharp.any():
        faces, parent = split_at(sharp, edges, faces)
        vertices = vertices[parent]
        edges = find_edges(faces, len(vertices))
    rim = np.zeros(len(vertices), bool)
    rim[edges.ends[edges.faces[:, 1] < 0]] = True
    faired = smooth(vertices, faces, detail=detail, rim=rim)
    bend = osculate(faired, edges, curvature(faired, faces))
    radius = bounding_radius(faired[bend.areas > 0])
    return Surface(vertices, faces, edges, bend, radius, eye, eye.towards(vertices), rimmed)


def bounding_radius(points: Floats) -> float:
    """Radius about the middle of the points' box, mm; 0 if there are none."""
    if len(points) == 0:
        return 0.0
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return float(np.sqrt(((points - middle) ** 2).sum(axis=1).max()))
