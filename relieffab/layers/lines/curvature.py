"""How a mesh bends: normals, principal curvatures and how they change, per vertex.

S. Rusinkiewicz, "Estimating curvatures and their derivatives on triangle
meshes", 3DPVT 2004.  Inside, arrays are component-major, (3, f) and (3, v), so
that each step is a plain sum of rows; corner i of a face lies opposite edge i.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

FLATTEST = 1e-7
"""A triangle less high than this, as a share of its longest edge, has no curvature to tell."""


@dataclass(frozen=True, eq=False)
class Curvature:
    """What bending a surface has at each vertex; convex is positive.

    Parameters
    ----------
    normals : (v, 3) ndarray
        Unit, outward.
    directions : (2, v, 3) ndarray
        Unit principal directions e1 and e2 = n x e1.
    principal : (2, v) ndarray
        k1 and k2 along them, 1/mm, |k1| >= |k2|.
    derivative : (4, v) ndarray
        C0..C3 in the principal frame, 1/mm^2.
    areas : (v,) ndarray
        Voronoi area, mm^2; 0 at vertices no triangle uses.
    """

    normals: Floats
    directions: Floats
    principal: Floats
    derivative: Floats
    areas: Floats

    def moved(self, rotation: Floats, scale: float) -> "Curvature":
        """Turn by a rotation, (3, 3), and scale: what is measured in 1/mm shrinks."""
        return Curvature(
            normals=self.normals @ rotation.T,
            directions=self.directions @ rotation.T,
            principal=self.principal / scale,
            derivative=self.derivative / scale**2,
            areas=self.areas * scale**2,
        )


@dataclass(frozen=True, eq=False)
class _Faces:
    """Frames and edges of the triangles worth measuring, component-major."""

    corners: Ints  # (3, f)
    normal: Floats  # (3, f)
    tangent: Floats  # (3, f), along edge 0
    across: Floats  # (3, f), normal x tangent
    u: Floats  # (3, f), edge i along tangent
    w: Floats  # (3, f), edge i along across
    squared: Floats  # (3, f), |edge i|^2
    twice_area: Floats  # (f,)


def _dot(a: Floats, b: Floats) -> Floats:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Floats, b: Floats) -> Floats:
    return np.stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def _gather(corners: Ints, per_corner: Floats, count: int) -> Floats:
    """Sum corner values (3, f) at their vertices: (v,)."""
    total = np.bincount(corners.ravel(), weights=per_corner.ravel(), minlength=count)
    return total.astype(np.float64)


def _measure(vertices: Floats, faces: Ints) -> _Faces:
    """Lay a frame on each triangle that has an area; the others are left out."""
    points = np.ascontiguousarray(vertices.T, dtype=np.float64)
    corners = np.ascontiguousarray(faces.T)
    a, b, c = (points[:, corners[i]] for i in range(3))
    edges = [c - b, a - c, b - a]
    squared = np.stack([_dot(e, e) for e in edges])
    normal = _cross(edges[0], edges[1])
    twice_area = np.sqrt(_dot(normal, normal))
    good = twice_area > FLATTEST * squared.max(axis=0, initial=0.0)
    if not good.all():
        edges = [e[:, good] for e in edges]
        corners, squared = corners[:, good], squared[:, good]
        normal, twice_area = normal[:, good], twice_area[good]
    normal = normal / twice_area
    tangent = edges[0] / np.sqrt(squared[0])
    across = _cross(normal, tangent)
    u = np.stack([_dot(e, tangent) for e in edges])
    w = np.stack([_dot(e, across) for e in edges])
    return _Faces(corners, normal, tangent, across, u, w, squared, twice_area)


def _unit_normals(f: _Faces, count: int) -> Floats:
    """Sum (a x b)/(|a|^2 |b|^2) over the corners (Max 1999), component-major.

    A vertex whose sum vanishes looks up: no triangle, or as many each way.
    """
    weights = np.stack([f.twice_area / (f.squared[i - 2] * f.squared[i - 1]) for i in range(3)])
    total = np.stack([_gather(f.corners, weights * f.normal[k], count) for k in range(3)])
    length = np.sqrt(_dot(total, total))
    flat = length <= 1e-12 * _gather(f.corners, weights, count)
    total[:, flat] = np.array([[0.0], [0.0], [1.0]])
    return total / np.where(flat, 1.0, length)


def _corner_areas(f: _Faces) -> Floats:
    """Share each triangle out to its corners, each point to its nearest: (3, f), mm^2."""
    cot = np.stack(
        [-(f.u[i - 2] * f.u[i - 1] + f.w[i - 2] * f.w[i - 1]) / f.twice_area for i in range(3)]
    )
    part = f.squared * cot / 8
    areas = part[[1, 2, 0]] + part[[2, 0, 1]]
    for blunt in range(3):
        wide = cot[blunt] < 0
        total = f.twice_area[wide] / 2
        for sharp, edge in ((blunt - 2, blunt - 1), (blunt - 1, blunt - 2)):
            # The side between blunt and sharp lies opposite the third corner.
            areas[sharp, wide] = f.squared[edge, wide] / (8 * cot[sharp, wide])
            total = total - areas[sharp, wide]
        areas[blunt, wide] = total
    return areas


def _any_tangents(n: Floats) -> Floats:
    """Choose a unit vector at right angles to each normal (Duff et al., JCGT 2017): (3, v)."""
    sign = np.where(n[2] < 0, -1.0, 1.0)
    a = -1 / (sign + n[2])
    return np.stack([1 + sign * n[0] ** 2 * a, sign * n[0] * n[1] * a, -sign * n[0]])


def _solve_tridiagonal(diagonal: list[Floats], off: list[Floats], right: list[Floats]) -> Floats:
    """Solve one small symmetric positive tridiagonal system per face (Thomas)."""
    d, r = list(diagonal), list(right)
    for i in range(1, len(d)):
        factor = off[i - 1] / d[i - 1]
        d[i] = d[i] - factor * off[i - 1]
        r[i] = r[i] - factor * r[i - 1]
    r[-1] = r[-1] / d[-1]
    for i in range(len(d) - 2, -1, -1):
        r[i] = (r[i] - off[i] * r[i + 1]) / d[i]
    return np.stack(r)


def _along_edges(f: _Faces, values: Floats) -> tuple[Floats, Floats]:
    """Sum (difference along edge i) x (edge i) in the face's frame."""
    d = values[[2, 0, 1]] - values[[1, 2, 0]]
    return (f.u * d).sum(axis=0), (f.w * d).sum(axis=0)


def _moments(f: _Faces) -> tuple[Floats, Floats, Floats]:
    return (f.u * f.u).sum(axis=0), (f.u * f.w).sum(axis=0), (f.w * f.w).sum(axis=0)


def _fit_curvature(f: _Faces, n_t: Floats, n_b: Floats) -> Floats:
    """Second fundamental form (e, f, g) of each face by least squares: sec. 2, (3, f)."""
    a, b, c = _moments(f)
    tu, tw = _along_edges(f, n_t)
    bu, bw = _along_edges(f, n_b)
    return _solve_tridiagonal([a, a + c, c], [b, b], [tu, tw + bu, bw])


def _fit_derivative(f: _Faces, e: Floats, m: Floats, g: Floats) -> Floats:
    """C0..C3 of each face from the tensors [[e, m], [m, g]] at its corners: sec. 3, (4, f)."""
    a, b, c = _moments(f)
    eu, ew = _along_edges(f, e)
    mu, mw = _along_edges(f, m)
    gu, gw = _along_edges(f, g)
    right = [eu, ew + 2 * mu, 2 * mw + gu, gw]
    return _solve_tridiagonal([a, c + 2 * a, 2 * c + a, c], [b, 2 * b, b], right)


Basis = tuple[Floats, Floats, Floats, Floats]
"""(a, b, c, d): new basis vectors a e1 + b e2 and c e1 + d e2."""


def turned(cos: Floats, sin: Floats) -> Basis:
    """Return the basis turned by an angle."""
    return cos, sin, -sin, cos


def tensor_in(t: Floats, basis: Basis) -> Floats:
    """Components (3, ...) of a symmetric tensor in another basis."""
    a, b, c, d = basis
    e, m, g = t
    return np.stack(
        [
            e * (a * a) + m * (2 * a * b) + g * (b * b),
            e * (a * c) + m * (a * d + b * c) + g * (b * d),
            e * (c * c) + m * (2 * c * d) + g * (d * d),
        ]
    )


def cubic_in(t: Floats, basis: Basis) -> Floats:
    """Components (4, ...) of a symmetric cubic form in another basis."""
    a, b, c, d = basis
    t0, t1, t2, t3 = t
    aa, ab, bb, cc, cd, dd = a * a, a * b, b * b, c * c, c * d, d * d
    return np.stack(
        [
            t0 * (aa * a) + t1 * (3 * aa * b) + t2 * (3 * a * bb) + t3 * (bb * b),
            t0 * (aa * c) + t1 * (2 * ab * c + aa * d) + t2 * (bb * c + 2 * ab * d) + t3 * (bb * d),
            t0 * (a * cc) + t1 * (2 * a * cd + b * cc) + t2 * (a * dd + 2 * b * cd) + t3 * (b * dd),
            t0 * (cc * c) + t1 * (3 * cc * d) + t2 * (3 * c * dd) + t3 * (dd * d),
        ]
    )


def diagonalise(tensor: Floats) -> tuple[Floats, Floats, Floats]:
    """Principal curvatures (2, v), |k1| >= |k2|, and the turn (c, s) to their frame."""
    e, m, g = tensor
    mean, half = (e + g) / 2, (e - g) / 2
    radius = np.hypot(half, m)
    larger = np.where(mean < 0, -1.0, 1.0)  # the sign that makes |k1| the larger
    angle = np.arctan2(larger * m, larger * half) / 2
    principal = np.stack([mean + larger * radius, mean - larger * radius])
    return principal, np.cos(angle), np.sin(angle)


def curvature(vertices: Floats, faces: Ints) -> Curvature:
    """Measure normals, principal curvatures and their derivative.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
        Outward-oriented.  Triangles without area count for nothing.

    Returns
    -------
    Curvature
        Finite everywhere; 0 at vertices without a triangle of any area.
    """
    count = len(vertices)
    f = _measure(vertices, faces)
    normals = _unit_normals(f, count)
    corner_areas = _corner_areas(f)
    areas = _gather(f.corners, corner_areas, count)
    weights = corner_areas / np.maximum(areas, np.finfo(float).tiny)[f.corners]

    e1 = _any_tangents(normals)
    n_t, n_b, c, s = _into_faces(f, normals, e1)
    form = _fit_curvature(f, n_t, n_b)
    in_vertices = tensor_in(form[:, None], turned(c, s))
    tensor = np.stack([_gather(f.corners, weights * part, count) for part in in_vertices])

    principal, cos, sin = diagonalise(tensor)
    e2 = _cross(normals, e1)
    e1, e2 = cos * e1 + sin * e2, cos * e2 - sin * e1
    cos, sin = cos[f.corners], sin[f.corners]
    c, s = c * cos - s * sin, s * cos + c * sin

    k1, k2 = principal[:, f.corners]
    cubic = _fit_derivative(f, k1 * c * c + k2 * s * s, (k1 - k2) * c * s, k1 * s * s + k2 * c * c)
    in_vertices = cubic_in(cubic[:, None], turned(c, s))
    derivative = np.stack([_gather(f.corners, weights * part, count) for part in in_vertices])
    directions = np.stack([e1.T, e2.T])
    return Curvature(normals.T.copy(), directions, principal, derivative, areas)


def _into_faces(f: _Faces, n: Floats, e1: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """See vertex frames from faces: normals' parts along the face, and the turn (c, s).

    A vertex frame is first tipped onto the face, the shortest way; e1 then lies
    at c along the face's tangent and s across it.
    """
    shape = f.corners.shape
    n_t, n_b, c, s = (np.empty(shape) for _ in range(4))
    for i in range(3):
        normal, first = n[:, f.corners[i]], e1[:, f.corners[i]]
        n_t[i], n_b[i] = _dot(normal, f.tangent), _dot(normal, f.across)
        tip = _dot(first, f.normal) / np.maximum(1 + _dot(normal, f.normal), 1e-6)
        c[i] = _dot(first, f.tangent) - n_t[i] * tip
        s[i] = _dot(first, f.across) - n_b[i] * tip
    length = np.hypot(c, s)
    lost = length < 1e-6  # a vertex normal straight against the face
    length[lost], c[lost] = 1.0, 1.0
    return n_t, n_b, c / length, s / length
