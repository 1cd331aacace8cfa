"""Lines in closed form, for the meshes of `relieffab.subject.shapes`."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.interpolate import interp1d
from skimage.measure import find_contours

from relieffab.layers.lines.contours import LEAST, fading
from relieffab.layers.lines.creases import find_creases
from relieffab.layers.lines.edges import find_edges
from relieffab.layers.lines.surface import prepare


def rotation(tilt, spin):
    """Turn a model so that the viewer, on +Z, sees its Z axis tilted by `tilt` radians."""
    c, s, cs, ss = np.cos(tilt), np.sin(tilt), np.cos(spin), np.sin(spin)
    about_x = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return about_x @ np.array([[cs, -ss, 0], [ss, cs, 0], [0, 0, 1]])


@dataclass(frozen=True)
class Patch:
    """A parametric surface over the unit square, differentiated by central differences."""

    surface: object

    def point(self, u, v):
        shape = np.shape(u)
        return self.surface(np.ravel(u), np.ravel(v)).reshape(*shape, 3)

    def forms(self, u, v, h=1e-4):
        """First and second fundamental forms (E, F, G), (L, M, N), the normal and r_u, r_v."""
        r = self.point
        ru = (r(u + h, v) - r(u - h, v)) / (2 * h)
        rv = (r(u, v + h) - r(u, v - h)) / (2 * h)
        ruu = (r(u + h, v) - 2 * r(u, v) + r(u - h, v)) / h**2
        rvv = (r(u, v + h) - 2 * r(u, v) + r(u, v - h)) / h**2
        ruv = (r(u + h, v + h) - r(u + h, v - h) - r(u - h, v + h) + r(u - h, v - h)) / (4 * h**2)
        n = np.cross(ru, rv)
        n /= np.linalg.norm(n, axis=-1, keepdims=True)
        dot = lambda a, b: (a * b).sum(axis=-1)  # noqa: E731
        first = dot(ru, ru), dot(ru, rv), dot(rv, rv)
        second = tuple(-dot(n, second) for second in (ruu, ruv, rvv))  # convex is positive
        return first, second, n, ru, rv

    def radial(self, u, v, view):
        """n.v, kr sin^2, and the view's tangential part in parameters (du, dv)."""
        (e, f, g), (uu, uv, vv), normal, ru, rv = self.forms(u, v)
        a, b = ru @ view, rv @ view
        area2 = e * g - f * f
        du, dv = (g * a - f * b) / area2, (e * b - f * a) / area2
        return normal @ view, uu * du * du + 2 * uv * du * dv + vv * dv * dv, du, dv

    def suggestive(self, view, size, count=700):
        """Points, strength and n.v along kr = 0, from the formula alone."""
        axis = np.linspace(0, 1, count + 1)
        u, v = np.meshgrid(axis, axis, indexing="ij")
        lines = find_contours(self.radial(u, v, view)[1], 0.0)
        at = [interp1d(np.arange(len(q)), q, axis=0)(np.arange(0, len(q) - 1, 0.1)) for q in lines]
        u, v = np.concatenate(at).T / count
        facing, _, du, dv = self.radial(u, v, view)
        sine2 = 1 - facing**2
        h = 1e-4
        ahead, behind = (self.radial(u + s * h * du, v + s * h * dv, view)[1] for s in (1, -1))
        change = (ahead - behind) / (2 * h) / sine2
        aslant = np.where(np.abs(facing) > 1e-9, facing, 1e-9)
        return self.point(u, v), fading(change * size**2 / aslant, LEAST), facing

    def contours(self, view, count=700):
        """Points and kr along n.v = 0."""
        axis = np.linspace(0, 1, count + 1)
        u, v = np.meshgrid(axis, axis, indexing="ij")
        lines = find_contours(self.radial(u, v, view)[0], 0.0)
        at = [interp1d(np.arange(len(q)), q, axis=0)(np.arange(0, len(q) - 1, 0.1)) for q in lines]
        u, v = np.concatenate(at).T / count
        return self.point(u, v), self.radial(u, v, view)[1]


def prepared(vertices, faces, **options):
    """Make a surface ready for its lines, creases parted."""
    edges = find_edges(faces, len(vertices))
    creases = find_creases(vertices, faces, edges, 0.0)
    return prepare(vertices, faces, creases, edges, **options)


@pytest.fixture(scope="session")
def patch():
    return Patch


@pytest.fixture(scope="session", name="rotation")
def rotation_fixture():
    return rotation


@pytest.fixture(scope="session", name="prepared")
def prepared_fixture():
    return prepared
