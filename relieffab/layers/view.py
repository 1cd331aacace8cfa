"""View: from where the model is seen, and how it then sits on the panel."""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError, suggest
from relieffab.layers.mesh import Mesh

Floats = NDArray[np.float64]

VIEWS = {
    "front": (0.0, 0.0),
    "right": (90.0, 0.0),
    "back": (180.0, 0.0),
    "left": (-90.0, 0.0),
    "top": (0.0, 90.0),
    "bottom": (0.0, -90.0),
}

# Model axes to a frame with X right, Y away from the viewer at the front, Z up.
_TO_Z_UP = {
    "z": np.eye(3),
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
}


@dataclass(frozen=True)
class View:
    """An orthographic view.

    Parameters
    ----------
    azimuth : float
        Where the viewer stands, degrees; 0 is the front, 90 the model's right as
        drawn (+X).
    elevation : float
        How far above the model, degrees.
    roll : float
        How far the picture is turned, degrees counter-clockwise.
    up : {'y', 'z'}
        The model's axis that points up.  The front's viewer stands at -Y where z
        is up, and at +Z where y is.
    """

    azimuth: float = 0.0
    elevation: float = 0.0
    roll: float = 0.0
    up: str = "z"

    def __post_init__(self) -> None:
        if self.up not in _TO_Z_UP:
            raise InputError("the up axis is not known", expected="y or z", found=repr(self.up))
        if not np.isfinite([self.azimuth, self.elevation, self.roll]).all():
            raise InputError("a view needs finite angles", found=f"{self}")

    @property
    def rotation(self) -> Floats:
        """Rows are the panel's X, Y and Z (to the viewer) in model axes, (3, 3)."""
        a, e, r = radians(self.azimuth), radians(self.elevation), radians(self.roll)
        right = np.array([cos(a), sin(a), 0.0])
        toward = np.array([sin(a) * cos(e), -cos(a) * cos(e), sin(e)])
        upward = np.cross(toward, right)
        turn = np.array([[cos(r), -sin(r), 0.0], [sin(r), cos(r), 0.0], [0.0, 0.0, 1.0]])
        return turn @ np.stack([right, upward, toward]) @ _TO_Z_UP[self.up]


def named_view(name: str, up: str, *, roll: float = 0.0) -> View:
    """Return the view of a name: front, right, back, left, top or bottom."""
    if name not in VIEWS:
        raise InputError("there is no view of that name", found=name, hint=suggest(name, VIEWS))
    azimuth, elevation = VIEWS[name]
    return View(azimuth, elevation, roll, up)


def guess_up(mesh: Mesh) -> str:
    """Guess which axis points up: the one under which the model stands.

    An axis's footing is the area that faces straight down within the lowest 2 %
    of the model's height, against the model's plan.  It decides where the file's
    format says nothing; what files of that format usually have up gives way only
    to a footing of a fifth of the plan, four times that of the usual axis.

    Returns
    -------
    {'y', 'z'}
    """
    footing = {"y": _footing(mesh, 1), "z": _footing(mesh, 2)}
    if mesh.usual_up is None:
        return "y" if footing["y"] > 1.2 * footing["z"] + 1e-12 else "z"
    other = "z" if mesh.usual_up == "y" else "y"
    strong = footing[other] > max(0.2, 4 * footing[mesh.usual_up])
    return other if strong else mesh.usual_up


def _footing(mesh: Mesh, axis: int) -> float:
    corners = mesh.vertices[mesh.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normal, axis=1)
    extent = np.ptp(mesh.vertices, axis=0)
    at_foot = corners[..., axis].mean(axis=1) < mesh.vertices[:, axis].min() + 0.02 * extent[axis]
    downward = normal[:, axis] < -0.9 * area
    plan = float(np.prod(np.delete(extent, axis)))
    return float(area[at_foot & downward].sum()) / plan if plan > 0 else 0.0


@dataclass(frozen=True, eq=False)
class Placed:
    """A mesh on the panel; arrays are read-only.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm, X right, Y away, Z to the viewer, the nearest point at Z0.
    faces : (f, 3) ndarray of int
    matrix : (4, 4) ndarray
        Homogeneous, from model units to panel mm.
    """

    vertices: Floats
    faces: NDArray[np.int64]
    matrix: Floats


def place(mesh: Mesh, view: View, size: tuple[float, float], *, margin: float) -> Placed:
    """Fit a model, seen from a view, into the panel.

    Parameters
    ----------
    mesh : Mesh
    view : View
    size : tuple of float
        Panel's X and Y, mm.
    margin : float
        Flat border that stays free all round, mm.

    Returns
    -------
    Placed
        Centred, as large as fits.

    Raises
    ------
    InputError
        If nothing is left inside the margin, or the model is flat or a needle as
        seen from there.
    """
    room = np.array(size) - 2 * margin
    if not (room > 0).all() or margin < 0:
        raise InputError(
            "the margin leaves no room for the figure",
            expected=f"a margin from 0 to under {min(size) / 2:g} mm",
            found=f"{margin:g} mm on a panel of {size[0]:g} x {size[1]:g} mm",
        )
    seen = (mesh.vertices - mesh.vertices.mean(axis=0)) @ view.rotation.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    extent = high - low
    if extent[:2].min() < 1e-3 * extent.max():
        raise InputError(
            "the model is seen edge on: there is no figure to carve",
            found=f"{extent[0]:.3g} wide, {extent[1]:.3g} high, {extent[2]:.3g} deep",
            where=mesh.name,
            hint="another --view or --up",
        )
    if extent[2] < 1e-4 * extent[:2].max():
        raise InputError(
            "the model is flat as seen from there: there is no depth to carve",
            found=f"{extent[0]:.3g} wide, {extent[1]:.3g} high, {extent[2]:.3g} deep",
            where=mesh.name,
            hint="another --view or --up",
        )
    scale = float((room / extent[:2]).min())
    matrix = np.eye(4)
    matrix[:3, :3] = scale * view.rotation
    middle = np.append((low + high)[:2] / 2, high[2])
    shift = np.append(np.array(size) / 2, 0.0) - scale * middle
    matrix[:3, 3] = shift - matrix[:3, :3] @ mesh.vertices.mean(axis=0)
    return Placed(scale * seen + shift, mesh.faces, matrix)
