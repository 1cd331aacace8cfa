"""One Chebyshev-smoothed V-cycle over a hierarchy of operators."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.multigrid.stored import Stored
from relieffab.relief.multigrid.transfer import prolong, restrict

Singles = NDArray[np.float32]
Bools = NDArray[np.bool_]

COARSEST = 300  # free nodes below which a level is only smoothed
# Degrees of the Chebyshev smoother, and down to which fraction it damps the spectrum's
# top: on the finest lattice further, for the sake of what coarse ones cannot show.
FINEST, OTHERS, COARSEST_SWEEPS = (2, 20.0), (2, 12.0), (16, 12.0)


class Level(Protocol):
    """What the cycle asks of an operator on one lattice."""

    @property
    def free(self) -> Bools:
        """Nodes to solve for."""

    @property
    def scale(self) -> Singles:
        """Reciprocal row sums of absolute couplings, 0 on fixed nodes."""

    def advance(
        self, x: Singles, rhs: Singles, step: Singles, out: Singles, keep: float, gain: float
    ) -> None:
        """Take one Chebyshev step: step = keep step + gain scale (rhs - A x), out = x + step."""

    def residual(self, x: Singles, rhs: Singles, out: Singles) -> None:
        """Subtract the product from the right-hand side; 0 on fixed nodes."""


def hierarchy(top: Stored) -> list[Stored]:
    """Coarsen until little is left.

    Parameters
    ----------
    top : Stored

    Returns
    -------
    list of Stored
        From `top` on.
    """
    levels = [top]
    while np.count_nonzero(levels[-1].free) > COARSEST and min(levels[-1].free.shape) > 12:
        levels.append(levels[-1].coarse())
    return levels


class Chebyshev(NamedTuple):
    """How far one step of a smoother goes: step = keep step + gain scale residual."""

    keep: float
    gain: float


def chebyshev(degree: int, reach: float) -> list[Chebyshev]:
    """List the steps that damp the spectrum from 1 down to 1 / reach (Saad 2003, Alg. 12.1)."""
    centre, half = (1.0 + 1.0 / reach) / 2, (1.0 - 1.0 / reach) / 2
    rho, steps = half / centre, [Chebyshev(0.0, 1.0 / centre)]
    for _ in range(degree - 1):
        following = 1.0 / (2.0 * centre / half - rho)
        steps.append(Chebyshev(following * rho, 2.0 * following / half))
        rho = following
    return steps


class Scratch(NamedTuple):
    """Lattices that a level works on, 0 outside its free nodes."""

    rhs: Singles
    x: Singles
    other: Singles
    step: Singles


class Cycle:
    """A symmetric V-cycle; its memory is kept from one call to the next.

    Parameters
    ----------
    levels : sequence of Level
        Finest first.
    """

    def __init__(self, levels: Sequence[Level]) -> None:
        self.levels = levels
        self._scratch = [
            Scratch(*(np.zeros(level.free.shape, np.float32) for _ in range(4))) for level in levels
        ]

    def __call__(self, rhs: Singles) -> Singles:
        """Solve roughly from 0.

        Parameters
        ----------
        rhs : (n, m) ndarray of float32
            0 on fixed nodes.

        Returns
        -------
        (n, m) ndarray of float32
            Overwritten by the next call.
        """
        return self._visit(0, rhs)

    def _visit(self, depth: int, rhs: Singles) -> Singles:
        level, own = self.levels[depth], self._scratch[depth]
        last = depth == len(self.levels) - 1
        smoothing = OTHERS if depth else FINEST
        first, *rest = chebyshev(*(COARSEST_SWEEPS if last else smoothing))
        np.multiply(level.scale, rhs, out=own.step)
        np.multiply(own.step, np.float32(first.gain), out=own.step)
        np.copyto(own.x, own.step)
        x, other = self._smooth(level, rhs, own.x, own.other, own.step, rest)
        if last:
            return x
        level.residual(x, rhs, own.step)
        below = self._scratch[depth + 1].rhs
        restrict(own.step, below)
        below *= self.levels[depth + 1].free
        prolong(self._visit(depth + 1, below), level.free, x)
        x, _ = self._smooth(level, rhs, x, other, own.step, chebyshev(*smoothing))
        return x

    @staticmethod
    def _smooth(
        level: Level, rhs: Singles, x: Singles, other: Singles, step: Singles,
        steps: list[Chebyshev],
    ) -> tuple[Singles, Singles]:  # fmt: skip
        """Take the steps; returns the better x, and the lattice left over."""
        for keep, gain in steps:
            level.advance(x, rhs, step, other, keep, gain)
            x, other = other, x
        return x, other
