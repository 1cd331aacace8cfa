"""Layers to Relief: projected Gauss-Newton steps, from coarse to fine."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.progress import Progress, silent
from relieffab.relief.energy import Terms, linearise, operator
from relieffab.relief.model import Relief
from relieffab.relief.multigrid import build, solve
from relieffab.relief.targets import BORDER, Carving, terms_of, to_nodes, wall

Floats = NDArray[np.float64]

COARSEST = 64  # rows or columns of pixels below which no coarser grid helps


@dataclass(frozen=True)
class Solution:
    """How the solver came to its relief.

    Parameters
    ----------
    energy : dict of float
        'slope', 'light', 'form' and 'total', without unit.
    residual : float
        Norm of the projected gradient, relative to the first guess's.
    iterations : int
        Gauss-Newton steps on the finest lattice.
    inner : int
        Conjugate gradient iterations on the finest lattice.
    """

    energy: dict[str, float]
    residual: float
    iterations: int
    inner: int


def projected_gradient(gradient: Floats, h: Floats, depth: float) -> Floats:
    """Drop the components that only push against a bound."""
    at_low = (h <= -depth) & (gradient > 0)
    at_high = (h >= 0) & (gradient < 0)
    return np.where(at_low | at_high, 0.0, gradient)


def descend(
    terms: Terms, h: Floats, *, tolerance: float, most: int, report: Progress = silent
) -> tuple[Floats, Solution]:
    """Minimise the energy within the bounds by projected Newton steps.

    Bounds that the gradient pushes against are held, a Gauss-Newton step is taken
    on the rest and projected back (Bertsekas 1982); it is halved until the energy
    falls.

    Parameters
    ----------
    terms : Terms
    h : (n, m) ndarray
        First guess, mm, within the bounds.
    tolerance : float
        On the projected gradient, relative to the first guess's.
    most : int
        Steps at most.

    Returns
    -------
    h : (n, m) ndarray
    solution : Solution
    """
    figure = terms.form_weight > 0
    here = linearise(terms, h)
    first = norm = float(np.linalg.norm(projected_gradient(here.gradient, h, terms.depth)))
    inner = iteration = 0
    while iteration < most and norm > tolerance * first and first > 0:
        report("relief", iteration, most)
        pull = projected_gradient(here.gradient, h, terms.depth)
        at_bound = (h <= -terms.depth) | (h >= 0)
        free = figure & ~(at_bound & (pull == 0))
        levels = build(operator(terms, here), free)
        forcing = min(0.1, max(0.3 * tolerance, 0.3 * norm / first))
        step, used = solve(levels, -0.5 * pull, tolerance=forcing)
        inner += used
        size, there, new = 1.0, here, h
        while size > 1e-3:
            new = np.clip(h + size * step, -terms.depth, 0.0)
            there = linearise(terms, new)
            if there.value < here.value:
                break
            size /= 2
        else:
            break
        h, here = new, there
        norm = float(np.linalg.norm(projected_gradient(here.gradient, h, terms.depth)))
        iteration += 1
    energy = {**here.parts, "total": here.value}
    return h, Solution(energy, norm / first if first > 0 else 0.0, iteration, inner)


def halve(layers: Layers) -> Layers:
    """Layers at twice the pitch: of each four pixels the nearest stays."""
    rows, cols = -(-layers.grid.rows // 2), -(-layers.grid.cols // 2)

    def blocks(array: NDArray[np.generic]) -> NDArray[np.generic]:
        pad = [(0, 2 * rows - array.shape[0]), (0, 2 * cols - array.shape[1])]
        padded = np.pad(array, pad + [(0, 0)] * (array.ndim - 2))
        split = padded.reshape(rows, 2, cols, 2, *array.shape[2:])
        return split.swapaxes(1, 2).reshape(rows, cols, 4, *array.shape[2:])

    near = np.where(layers.mask, layers.depth, -np.inf)
    nearest = blocks(near).argmax(axis=2)

    def pick(array: NDArray[np.generic]) -> NDArray[np.generic]:
        index = nearest.reshape(rows, cols, 1, *[1] * (array.ndim - 2))
        return np.take_along_axis(blocks(array), index, axis=2)[:, :, 0]

    normals = pick(layers.normals)
    normals[~pick(layers.mask)] = (0.0, 0.0, 1.0)
    return Layers(
        grid=Grid(rows, cols, 2 * layers.pitch, layers.grid.origin),
        depth=pick(layers.depth),
        normals=normals,
        mask=pick(layers.mask),
        lights=layers.lights.copy(),
        shading=np.stack([pick(image) for image in layers.shading]),
        lines=blocks(layers.lines).mean(axis=2),
    )


def _first_guess(coarse: Floats, shape: tuple[int, int]) -> Floats:
    """Carry heights to a lattice of half the pitch; nodes of one lie on the other's."""
    fine = np.zeros((2 * coarse.shape[0] - 1, 2 * coarse.shape[1] - 1))
    fine[::2, ::2] = coarse
    fine[1::2, ::2] = (coarse[1:] + coarse[:-1]) / 2
    fine[:, 1::2] = (fine[:, :-1:2] + fine[:, 2::2]) / 2
    return fine[: shape[0], : shape[1]]


def _solve_on(
    layers: Layers, carving: Carving, tolerance: float, report: Progress
) -> tuple[Floats, Solution]:
    """Heights on all nodes of the layers' grid, coarser grids first."""
    figure, place = _cropped(layers)
    terms = terms_of(figure, carving)
    guess = terms.form
    if min(figure.grid.shape) > COARSEST:
        coarse, _ = _solve_on(halve(layers), carving, max(tolerance, 1e-2), silent)
        guess = place.take(_first_guess(coarse, layers.grid.node_shape))
    guess = np.clip(guess, -terms.depth, 0.0) * (terms.form_weight > 0)
    heights, solution = descend(terms, guess, tolerance=tolerance, most=12, report=report)
    return place.put(heights, layers.grid.node_shape), solution


@dataclass(frozen=True)
class Window:
    """A part of a grid, which may reach beyond it.

    Parameters
    ----------
    top, left, rows, cols : int
        In pixels of the whole grid.
    """

    top: int
    left: int
    rows: int
    cols: int

    def take(self, whole: NDArray[Any], *, nodes: bool = True) -> NDArray[Any]:
        """Cut the window out, with zeros beyond the grid."""
        more = int(nodes)
        out = np.zeros((self.rows + more, self.cols + more, *whole.shape[2:]), whole.dtype)
        mine, theirs = self._overlap(whole.shape, more)
        out[mine] = whole[theirs]
        return out

    def put(self, part: Floats, shape: tuple[int, int]) -> Floats:
        """Lay node values back into zeros of the whole grid's shape."""
        out = np.zeros(shape)
        mine, theirs = self._overlap(shape, 1)
        out[theirs] = part[mine]
        return out

    def _overlap(
        self, shape: tuple[int, ...], more: int
    ) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
        mine, theirs = [], []
        for start, size, whole in zip(
            (self.top, self.left), (self.rows + more, self.cols + more), shape[:2], strict=True
        ):
            low, high = max(start, 0), min(start + size, whole)
            theirs.append(slice(low, high))
            mine.append(slice(low - start, high - start))
        return (mine[0], mine[1]), (theirs[0], theirs[1])


def _cropped(layers: Layers) -> tuple[Layers, Window]:
    """The figure alone with a border of background."""
    rows, cols = np.nonzero(layers.mask)
    top, left = int(rows.min()) - BORDER, int(cols.min()) - BORDER
    window = Window(
        top, left, int(rows.max()) + 1 + BORDER - top, int(cols.max()) + 1 + BORDER - left
    )
    mask = window.take(layers.mask, nodes=False)
    normals = window.take(layers.normals, nodes=False)
    normals[~mask] = (0.0, 0.0, 1.0)
    figure = Layers(
        grid=Grid(window.rows, window.cols, layers.pitch, layers.grid.to_xy(top, left)),
        depth=window.take(layers.depth, nodes=False),
        normals=normals,
        mask=mask,
        lights=layers.lights,
        shading=np.stack([window.take(image, nodes=False) for image in layers.shading]),
        lines=window.take(layers.lines, nodes=False),
    )
    return figure, window


def make_relief(
    layers: Layers,
    carving: Carving | None = None,
    *,
    tolerance: float = 1e-3,
    progress: Progress = silent,
) -> tuple[Relief, Solution]:
    """Turn three aligned images into one height field within its bounds.

    Parameters
    ----------
    layers : Layers
    carving : Carving, optional
    tolerance : float
        On the projected gradient, relative to the first guess's.
    progress : Progress

    Returns
    -------
    relief : Relief
        -depth <= h <= 0 exactly, 0 outside the figure, its highest point at 0.
    solution : Solution
    """
    carving = carving or Carving()
    heights, solution = _solve_on(layers, carving, tolerance, progress)
    figure = to_nodes(layers.mask.astype(float), np.ones(layers.grid.shape)) > 0
    heights[figure] -= heights[figure].max()
    heights = np.maximum(heights, wall(layers.mask, layers.pitch, carving.wall_angle))
    return Relief(layers.grid, heights, layers.mask, carving.depth), solution
