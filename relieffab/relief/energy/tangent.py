"""The Gauss-Newton operator of the energy, applied without being stored.

Half the Hessian that the squares' linearisations at one height field have: the
slopes there are all it keeps.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.relief.energy.rows import (
    buffers,
    gather,
    pull,
    push,
    shine,
    strain,
    tilt,
)
from relieffab.relief.energy.terms import ROWS, Terms, asked, spans

Singles = NDArray[np.float32]
Bools = NDArray[np.bool_]


@kernel
def _next(x, p, q, weighing, lights, c, i, first, lo, width, b):  # type: ignore[no-untyped-def]
    """Take in pixel row i; node row i - 1 is finished then."""
    strain(x, weighing, c, i, lo, width, b)
    tilt(p[i, lo : lo + width], q[i, lo : lo + width], lights, c, i, b)
    shine(x, i, lo, width, b)
    if i >= first - 1:
        pull(weighing, c, i, lo, width, b)
    if i >= first:
        push(i - 1, width, b)
    if i > first:
        gather(x, c, i - 1, lo, width, b)


@parallel_kernel
def _apply(x, p, q, weighing, lights, c, places, free, out):  # type: ignore[no-untyped-def]
    """Multiply by the operator."""
    n = len(x)
    for block in prange(len(places)):
        first, lo, hi = 2 + block * ROWS, places[block, 0], places[block, 1]
        b = buffers(len(lights), hi - lo, x)
        for i in range(first - 2, min(first + ROWS, n - 2) + 1 if hi > lo else 0):
            _next(x, p, q, weighing, lights, c, i, first, lo, hi - lo, b)
            if i > first:
                row, open_ = out[i - 1, lo:hi], free[i - 1, lo:hi]
                for k in range(1, hi - lo):
                    row[k] = b.total[k] if open_[k] else 0.0


@parallel_kernel
def _advance(  # type: ignore[no-untyped-def]
    x, p, q, weighing, lights, c, places, scale, rhs, step, out, keep, gain
):
    """One Chebyshev step: step = keep step + gain scale (rhs - A x), out = x + step."""
    n = len(x)
    for block in prange(len(places)):
        first, lo, hi = 2 + block * ROWS, places[block, 0], places[block, 1]
        b = buffers(len(lights), hi - lo, x)
        for i in range(first - 2, min(first + ROWS, n - 2) + 1 if hi > lo else 0):
            _next(x, p, q, weighing, lights, c, i, first, lo, hi - lo, b)
            if i > first:
                here, wanted = x[i - 1, lo:hi], rhs[i - 1, lo:hi]
                moves, there, scales = step[i - 1, lo:hi], out[i - 1, lo:hi], scale[i - 1, lo:hi]
                for k in range(1, hi - lo):
                    moves[k] = keep * moves[k] + gain * scales[k] * (wanted[k] - b.total[k])
                for k in range(1, hi - lo):
                    there[k] = here[k] + moves[k]


@parallel_kernel
def _residual(x, p, q, weighing, lights, c, places, free, rhs, out):  # type: ignore[no-untyped-def]
    """Subtract the product from the right-hand side."""
    n = len(x)
    for block in prange(len(places)):
        first, lo, hi = 2 + block * ROWS, places[block, 0], places[block, 1]
        b = buffers(len(lights), hi - lo, x)
        for i in range(first - 2, min(first + ROWS, n - 2) + 1 if hi > lo else 0):
            _next(x, p, q, weighing, lights, c, i, first, lo, hi - lo, b)
            if i > first:
                row, open_, wanted = out[i - 1, lo:hi], free[i - 1, lo:hi], rhs[i - 1, lo:hi]
                for k in range(1, hi - lo):
                    row[k] = wanted[k] - b.total[k] if open_[k] else 0.0


@dataclass(frozen=True, eq=False)
class Tangent:
    """Half the Gauss-Newton Hessian at one height field.

    Parameters
    ----------
    terms : Terms
    p, q : (n - 1, m - 1) ndarray of float32
        Slopes of the heights.
    """

    terms: Terms
    p: Singles
    q: Singles

    @cached_property
    def places(self) -> NDArray[np.int64]:
        """Columns of each block of rows, from `terms.spans`."""
        return spans(self.terms.figure)

    def given(self, kind: type[np.floating]) -> Any:
        """All that kernels take beside their vectors."""
        terms = self.terms
        lights = terms.lights.astype(kind)
        return self.p, self.q, asked(terms), lights, terms.constants(kind), self.places

    def apply(self, x: NDArray[np.floating], free: Bools, out: NDArray[np.floating]) -> None:
        """Multiply by the operator, in the precision of `x`.

        Parameters
        ----------
        x : (n, m) ndarray
            0 on nodes that are not free.
        free : (n, m) ndarray of bool
        out : (n, m) ndarray
            The product; 0 on nodes that are not free.
        """
        p, q, weighing, lights, c, places = self.given(x.dtype.type)
        _apply(x, p, q, weighing, lights, c, places, free, out)


@dataclass(frozen=True, eq=False)
class Finest:
    """The operator on its own lattice, as the first level of a hierarchy.

    Parameters
    ----------
    tangent : Tangent
    free : (n, m) ndarray of bool
        Nodes to solve for.
    scale : (n, m) ndarray of float32
        Reciprocal row sums of absolute couplings, 0 on fixed nodes.
    """

    tangent: Tangent
    free: Bools
    scale: Singles

    @cached_property
    def _given(self) -> Any:
        return self.tangent.given(np.float32)

    def advance(
        self, x: Singles, rhs: Singles, step: Singles, out: Singles, keep: float, gain: float
    ) -> None:
        """Take one Chebyshev step: step = keep step + gain scale (rhs - A x), out = x + step."""
        p, q, weighing, lights, c, places = self._given
        _advance(
            x, p, q, weighing, lights, c, places, self.scale, rhs, step, out,
            np.float32(keep), np.float32(gain),
        )  # fmt: skip

    def residual(self, x: Singles, rhs: Singles, out: Singles) -> None:
        """Subtract the product from the right-hand side; 0 on fixed nodes."""
        p, q, weighing, lights, c, places = self._given
        _residual(x, p, q, weighing, lights, c, places, self.free, rhs, out)
