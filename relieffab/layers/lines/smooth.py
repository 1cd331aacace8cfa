"""Fairing of the copy of a mesh that only gives lines."""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from relieffab.errors import InputError
from relieffab.layers.lines.aggregation import coarsen, cycle

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]
Complex = NDArray[np.complexfloating]

MOST_STEPS = 200
"""Conjugate gradients on real scans take under 30."""
ACCURACY = 1e-3
"""Of the displacement, relative."""


def laplacian(vertices: Floats, faces: Ints) -> tuple[sparse.csr_matrix, Floats]:
    """Cotangent Laplacian, each weight clamped at 0, and a third of the area per vertex.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int

    Returns
    -------
    matrix : (v, v) sparse matrix
        Positive semidefinite, rows summing to 0; no unit.
    areas : (v,) ndarray
        mm^2.
    """
    count = len(vertices)
    corners = vertices[faces]
    rows, cols, weights = [], [], []
    area = np.zeros(len(faces))
    for i in range(3):
        a, b = (corners[:, i - k] - corners[:, i] for k in (2, 1))
        cross = np.linalg.norm(np.cross(a, b), axis=1)
        dot = np.einsum("fk,fk->f", a, b)
        solid = cross > 1e-7 * np.abs(dot)
        weights.append(np.where(solid, dot, 0.0) / np.where(solid, cross, 1.0) / 2)
        rows.append(faces[:, i - 2])
        cols.append(faces[:, i - 1])
        area = cross / 2
    half = sparse.coo_matrix(
        (np.concatenate(weights), (np.concatenate(rows), np.concatenate(cols))), (count, count)
    ).tocsr()
    both = (half + half.T).maximum(0)
    matrix = sparse.diags(np.asarray(both.sum(axis=1)).ravel()) - both
    areas = np.bincount(faces.ravel(), weights=np.repeat(area / 3, 3), minlength=count)
    return matrix.tocsr(), areas.astype(np.float64)


def smooth(
    vertices: Floats, faces: Ints, *, detail: float, rim: NDArray[np.bool_] | None = None
) -> Floats:
    """Take detail off a mesh, and leave its forms and its volume as they are.

    An implicit filter like Desbrun et al., "Implicit fairing of irregular
    meshes", SIGGRAPH 1999, with weights clamped at 0 so that no triangle can fold
    over, but of second order: what is left of a ripple of wavelength w is
    1/(1 + (detail/w)^4), where one step of heat flow leaves 1/(1 + (detail/w)^2).
    Derivatives of curvature, which weigh a ripple by 1/w^3, come out smooth, and
    a ball of a few times the detail keeps its volume to 1e-4.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    detail : float
        A ripple of this wavelength keeps half its height, finer ones less, mm.
    rim : (v,) ndarray of bool, optional
        Vertices where the surface ends; it is not drawn inwards there.

    Returns
    -------
    (v, 3) ndarray
        mm; a new array.
    """
    moved = np.array(vertices, dtype=np.float64)
    if detail <= 0:
        return moved
    matrix, areas = laplacian(moved, faces)
    step = (detail / (2 * np.pi)) ** 2
    # A vertex without area stays where it is, as one without neighbours does.
    mass = np.where(areas > 0, areas, max(float(areas.max(initial=0.0)), 1.0))
    pull = step * (matrix @ moved)
    if rim is not None:
        pull[rim] = 0.0
    # With q the operator, -q^2/(1 + q^2) is the imaginary part of q/(1 + iq).
    return moved + _solve(step * matrix, mass, pull).imag


def _solve(matrix: sparse.csr_matrix, mass: Floats, right: Floats) -> NDArray[np.complex128]:
    """Solve (mass + i matrix) x = right for all columns at once.

    Conjugate gradients without conjugation (van der Vorst and Melissen, 1990),
    for the system is complex and symmetric.  They are preconditioned by mass +
    matrix: (1 + iq)/(1 + q) lies on an arc from 1 to i, off 0 by 0.7 at least,
    whatever the triangles.  Sums avoid the threaded BLAS, whose rounding depends
    on the number of threads.
    """
    # In single precision only ratios may be extreme, not the sizes.
    unit = mass.max(initial=0.0)
    levels = coarsen((matrix / unit + sparse.diags(mass / unit)).tocsr())
    weight = 1 / np.hypot(mass, matrix.diagonal())
    x, towards = np.zeros((2, *right.shape), np.complex128)
    residual = right.astype(np.complex128)
    energy = np.ones(right.shape[1], np.complex128)
    goal = ACCURACY**2 * _squares(residual, weight)
    for _ in range(MOST_STEPS):
        if (_squares(residual, weight) <= goal).all():
            return x
        parts = cycle(levels, residual.view(np.float64).astype(np.float32))
        scaled = parts.view(np.complex64)
        before, energy = energy, _sums(residual, scaled)
        towards *= _ratio(energy, before)
        towards += scaled
        image = mass[:, None] * towards
        image += 1j * (matrix @ towards.view(np.float64)).view(np.complex128)
        length = _ratio(energy, _sums(towards, image))
        x += length * towards
        residual -= length * image
    raise InputError(
        "the mesh cannot be smoothed for its lines",
        expected=f"a solution within {MOST_STEPS} steps",
        found="triangles of too unlike shapes",
        hint="repair the mesh, or take no detail off its lines",
    )


def _sums(a: NDArray[np.complex128], b: Complex) -> NDArray[np.complex128]:
    return np.einsum("vk,vk->k", a, b)


def _squares(a: NDArray[np.complex128], weight: Floats) -> Floats:
    parts = a.view(np.float64)
    return np.einsum("vk,vk,v->k", parts, parts, weight).reshape(-1, 2).sum(axis=1)


def _ratio(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> NDArray[np.complex128]:
    return np.divide(a, b, out=np.zeros_like(a), where=b != 0)
