"""View: from where the model is seen, and how it then sits on the panel."""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError, suggest
from relieffab.layers.eye import Eye
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

WIDEST = 120.0
"""Angle of view beyond which a figure is a caricature, degrees."""

# Model axes to a frame with X right, Y away from the viewer at the front, Z up.
_TO_Z_UP = {
    "z": np.eye(3),
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
}


@dataclass(frozen=True)
class View:
    """From where a model is seen, and how near.

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
    perspective : float
        Angle of view that the model's bounding sphere fills, degrees; 0 is
        orthographic.
    """

    azimuth: float = 0.0
    elevation: float = 0.0
    roll: float = 0.0
    up: str = "z"
    perspective: float = 0.0

    def __post_init__(self) -> None:
        if self.up not in _TO_Z_UP:
            raise InputError("the up axis is not known", expected="y or z", found=repr(self.up))
        if not np.isfinite([self.azimuth, self.elevation, self.roll]).all():
            raise InputError("a view needs finite angles", found=f"{self}")
        if not 0 <= self.perspective <= WIDEST:
            raise InputError(
                "the angle of view is out of range",
                expected=f"0 (orthographic) to {WIDEST:g} degrees",
                found=f"{self.perspective:g} degrees",
                where="perspective",
            )

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
        As seen, mm: X right, Y away, Z to the viewer, the nearest point at Z0;
        bent by the eye's homology if the view is in perspective.
    faces : (f, 3) ndarray of int
    matrix : (4, 4) ndarray
        Homogeneous, from model units to `vertices`.
    solid : (v, 3) ndarray
        The model's true shape in the same place, mm; `vertices` if the view is
        orthographic.
    eye : Eye
        From `solid` to `vertices`.
    """

    vertices: Floats
    faces: NDArray[np.int64]
    matrix: Floats
    solid: Floats
    eye: Eye

    def __post_init__(self) -> None:
        for array in (self.vertices, self.faces, self.matrix, self.solid):
            array.flags.writeable = False

    @classmethod
    def seen_from(
        cls, eye: Eye, solid: Floats, faces: NDArray[np.integer], matrix: Floats
    ) -> "Placed":
        """Look from an eye at a true shape that `matrix` took from model units to mm."""
        seen = eye.project(solid)
        return cls(seen, np.array(faces, np.int64), eye.matrix @ matrix, np.array(solid), eye)


def check_room(size: tuple[float, float], margin: float) -> Floats:
    """Return what a margin leaves of a panel, X and Y, mm.

    Raises
    ------
    InputError
        If nothing is left.
    """
    room = np.array(size) - 2 * margin
    if not (room > 0).all() or margin < 0:
        raise InputError(
            "the margin leaves no room for the figure",
            expected=f"a margin from 0 to under {min(size) / 2:g} mm",
            found=f"{margin:g} mm on a panel of {size[0]:g} x {size[1]:g} mm",
        )
    return room


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
    room = check_room(size, margin)
    turned = mesh.vertices @ view.rotation.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    _refuse_flat(high - low, mesh.name)
    # The foot of the eye: above the middle of the model, on its nearest plane.
    foot = np.append((low + high)[:2] / 2, high[2])
    nearness = _nearness(turned - foot, view.perspective)
    seen = Eye(nearness=nearness).project(turned - foot)
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    scale = float((room / (high - low)).min())
    x, y = np.array(size) / 2 - scale * (low + high) / 2
    matrix = np.eye(4)
    matrix[:3, :3] = scale * view.rotation
    matrix[:3, 3] = np.array([x, y, 0.0]) - scale * foot
    solid = scale * (turned - foot) + [x, y, 0.0]
    return Placed.seen_from(Eye(x, y, nearness / scale), solid, mesh.faces, matrix)


def _nearness(points: Floats, angle: float) -> float:
    """1 over the eye's height above Z0, from which points span an angle (degrees)."""
    middle = points[:, 2].min() / 2
    radius = float(np.linalg.norm(points - [0.0, 0.0, middle], axis=1).max())
    half = sin(radians(angle / 2))
    return half / (radius + half * middle)


def _refuse_flat(extent: Floats, name: str) -> None:
    found = f"{extent[0]:.3g} wide, {extent[1]:.3g} high, {extent[2]:.3g} deep"
    if extent[:2].min() < 1e-3 * extent.max():
        raise InputError(
            "the model is seen edge on: there is no figure to carve",
            found=found,
            where=name,
            hint="another --view or --up",
        )
    if extent[2] < 1e-4 * extent[:2].max():
        raise InputError(
            "the model is flat as seen from there: there is no depth to carve",
            found=found,
            where=name,
            hint="another --view or --up",
        )
