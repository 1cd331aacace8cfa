"""Layers at half the resolution, and heights carried back to twice as many nodes."""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import parallel_kernel, prange
from relieffab.grid import Grid
from relieffab.layers.model import Layers

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

RINGS = 2  # of nodes around the figure that cubics through its own reach


@parallel_kernel
def _halve(  # type: ignore[no-untyped-def]
    depth,
    normals,
    mask,
    shading,
    lines,
    half_depth,
    half_normals,
    half_mask,
    half_shading,
    half_lines,
):
    """Keep the nearest pixel of each four, and the mean of their ink."""
    rows, cols = mask.shape
    for i in prange(len(half_mask)):
        for j in range(half_mask.shape[1]):
            near, a, b, ink = -np.inf, 2 * i, 2 * j, 0.0
            for y in range(2 * i, min(2 * i + 2, rows)):
                for x in range(2 * j, min(2 * j + 2, cols)):
                    ink += lines[y, x]
                    if mask[y, x] and depth[y, x] > near:
                        near, a, b = depth[y, x], y, x
            half_lines[i, j] = ink / 4.0
            half_mask[i, j] = mask[a, b]
            half_depth[i, j] = depth[a, b]
            for k in range(3):
                half_normals[i, j, k] = normals[a, b, k]
            for k in range(len(shading)):
                half_shading[k, i, j] = shading[k, a, b]


def halve(layers: Layers) -> Layers:
    """Layers at twice the pitch: of each four pixels the nearest stays."""
    rows, cols = -(-layers.grid.rows // 2), -(-layers.grid.cols // 2)
    count = len(layers.lights)
    depth, normals = np.empty((rows, cols)), np.empty((rows, cols, 3))
    mask, shading = np.empty((rows, cols), bool), np.empty((count, rows, cols))
    lines = np.empty((rows, cols))
    _halve(
        layers.depth, layers.normals, layers.mask, layers.shading, layers.lines,
        depth, normals, mask, shading, lines,
    )  # fmt: skip
    grid = Grid(rows, cols, 2 * layers.pitch, layers.grid.origin)
    lights = layers.lights.copy()
    return Layers(grid, depth, normals, mask, lights, shading, lines, layers.strokes)


@parallel_kernel
def _spread(heights, known, out, reached):  # type: ignore[no-untyped-def]
    """Give nodes beside known ones the mean of those."""
    n, m = known.shape
    for i in prange(n):
        for j in range(m):
            out[i, j], reached[i, j] = heights[i, j], known[i, j]
            if known[i, j]:
                continue
            total, count = 0.0, 0
            for y in range(max(i - 1, 0), min(i + 2, n)):
                for x in range(max(j - 1, 0), min(j + 2, m)):
                    if known[y, x]:
                        total += heights[y, x]
                        count += 1
            if count:
                out[i, j], reached[i, j] = total / count, True


def refine(coarse: Floats, figure: Bools, shape: tuple[int, int]) -> Floats:
    """Carry heights to a lattice of half the pitch; nodes of one lie on the other's.

    Cubic, since the energy takes a kink for a cliff; what lies outside the figure
    takes no part.

    Parameters
    ----------
    coarse : (n, m) ndarray
    figure : (n, m) ndarray of bool
        Nodes whose heights count.
    shape : tuple of int
        Of the fine lattice, at most (2 n - 1, 2 m - 1).

    Returns
    -------
    ndarray
        Continued over two nodes beyond the figure, of no meaning further away.
    """
    heights, known = coarse, figure
    for _ in range(RINGS):
        out, reached = np.empty_like(heights), np.empty_like(known)
        _spread(heights, known, out, reached)
        heights, known = out, reached
    for axis in (0, 1):
        heights = np.swapaxes(_halfway(np.swapaxes(heights, 0, axis)), 0, axis)
    return heights[: shape[0], : shape[1]]


def _halfway(rows: Floats) -> Floats:
    """Put a row between each two: the cubic through the nearest four."""
    padded = np.pad(rows, ((1, 1), (0, 0)), mode="edge")
    between = (9 * (padded[1:-2] + padded[2:-1]) - padded[:-3] - padded[3:]) / 16
    out = np.empty((2 * len(rows) - 1, rows.shape[1]))
    out[::2], out[1::2] = rows, between
    return out
