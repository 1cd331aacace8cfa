"""Fairing of the copy of a mesh that only gives lines."""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from relieffab.errors import InputError

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

MOST_STEPS = 2000
"""Conjugate gradients on real scans take under 100."""


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


def smooth(vertices: Floats, faces: Ints, *, detail: float) -> Floats:
    """Take detail off a mesh by one implicit step of heat flow.

    Desbrun et al., "Implicit fairing of irregular meshes", SIGGRAPH 1999; with
    weights clamped at 0, so that no triangle can fold over.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    detail : float
        A ripple of this wavelength keeps half its height, finer ones less, mm.

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
    system = (sparse.diags(mass) + step * matrix).tocsr()
    return moved + _solve(system, -step * (matrix @ moved))


def _solve(system: sparse.csr_matrix, right: Floats, *, accuracy: float = 1e-3) -> Floats:
    """Solve for all columns at once by conjugate gradients, scaled by the diagonal.

    Sums avoid the threaded BLAS, whose rounding depends on the number of threads.
    """
    scale = 1 / system.diagonal()[:, None]
    x = np.zeros_like(right)
    residual = right.copy()
    towards = scale * residual
    energy = _sums(residual, towards)
    goal = accuracy**2 * energy
    for _ in range(MOST_STEPS):
        if (energy <= goal).all():
            return x
        image = system @ towards
        length = _ratio(energy, _sums(towards, image))
        x += length * towards
        residual -= length * image
        scaled = scale * residual
        new = _sums(residual, scaled)
        towards = scaled + _ratio(new, energy) * towards
        energy = new
    raise InputError(
        "the mesh cannot be smoothed for its lines",
        expected=f"a solution within {MOST_STEPS} steps",
        found="triangles of too unlike shapes",
        hint="repair the mesh, or take no detail off its lines",
    )


def _sums(a: Floats, b: Floats) -> Floats:
    return np.einsum("vk,vk->k", a, b)


def _ratio(a: Floats, b: Floats) -> Floats:
    return np.divide(a, b, out=np.zeros_like(a), where=b > 0)
