"""Everything that the energy of a relief needs to know, on one lattice."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Bools = NDArray[np.bool_]
Bounds = tuple[Singles, float]


@dataclass(frozen=True)
class Weights:
    """What the terms weigh, each already over the figure's number of pixels.

    Parameters
    ----------
    depth, line, twist : float
        Of slopes and twists of pixels.
    light : float
        Of gradients of radiance, mm².
    form : float
        Of heights, 1/mm².
    """

    depth: float
    line: float
    twist: float
    light: float
    form: float


@dataclass(frozen=True, eq=False)
class Terms:
    """What is asked of every pixel and node.

    The lattice carries a border of three fixed nodes.

    Parameters
    ----------
    pitch : float
        mm.
    lights : (k, 3) ndarray
    weights : Weights
    mask : (n - 1, m - 1) ndarray of bool
        Pixels of the figure that no occlusion touches: their slopes count as depth.
    stencil : (n - 1, m - 1) ndarray of float32
        How much a pixel belongs to a line, 0 to 1; 0 outside the figure.
    slope : (2, n - 1, m - 1) ndarray of float32
        Slopes asked for.
    whole : (n, m) ndarray of bool
        Nodes whose four pixels are one surface: their gradients of radiance count.
    radiance : (k, n - 1, m - 1) ndarray of float32 or None
        Radiance asked for, up to a constant a surface; None for that of the slopes
        asked for, to first order around them, which makes the energy quadratic.
    figure : (n, m) ndarray of bool
        Nodes of the figure; all others are fixed.
    form : (n, m) ndarray of float32
        mm, 0 outside the figure.
    bounds : tuple of (n, m) ndarray of float32 and float
        Lowest and highest height allowed, mm; infinite for none.
    lagged : bool
        Keep the normals' length out of the radiance's derivative, as the paper
        does (Wang 2011, Sect. 5.3).
    """

    pitch: float
    lights: Floats
    weights: Weights
    mask: Bools
    stencil: Singles
    slope: Singles
    whole: Bools
    radiance: Singles | None
    figure: Bools
    form: Singles
    bounds: Bounds
    lagged: bool = False

    def constants(self, kind: type[np.floating]) -> NDArray[np.floating]:
        """Pack the numbers that kernels multiply with; see `energy.rows`."""
        w, half = self.weights, 1 / (2 * self.pitch)
        squares = [2 * w.depth, 2 * w.line, w.twist, 2 * w.light]
        return np.array(
            [half, *(s * half**2 for s in squares), w.form, 0.0 if self.lagged else 1.0, 1.0],
            kind,
        )


class Asked(NamedTuple):
    """The arrays of `Terms` that weigh, as kernels take them."""

    mask: Bools
    stencil: Singles
    whole: Bools


def asked(terms: Terms) -> Asked:
    """Pick them out."""
    return Asked(terms.mask, terms.stencil, terms.whole)


ROWS = 32  # of the lattice in a block, which one thread takes at a time


def columns(figure: Bools, firsts: NDArray[np.int64], height: int) -> NDArray[np.int64]:
    """Columns that blocks of rows need, with two to spare on either side.

    Parameters
    ----------
    figure : (n, m) ndarray of bool
    firsts : (blocks,) ndarray of int
        First row of each.
    height : int
        Rows in each.

    Returns
    -------
    (blocks, 2) ndarray of int
        First column and one past the last; equal where there is nothing.
    """
    m = figure.shape[1]
    rows = np.asarray(figure.any(axis=1))
    first = np.where(rows, figure.argmax(axis=1), m)
    last = np.where(rows, m - figure[:, ::-1].argmax(axis=1), 0)
    out = np.zeros((len(firsts), 2), np.int64)
    for block, top in enumerate(firsts):
        near = slice(max(top, 0), top + height)
        if rows[near].any():
            out[block] = first[near].min() - 2, last[near].max() + 2
    return out


def spans(figure: Bools) -> NDArray[np.int64]:
    """Columns of each block of `ROWS` rows, from the third on."""
    return columns(figure, np.arange(2, len(figure) - 2, ROWS) - 2, ROWS + 4)
