"""Banding: a depth map of few levels, and the smoothest surface that rounds to it.

A smooth form stored in 256 greys becomes 256 plateaus with steps between them.  What
was stored lies within half a step of what is read; of all surfaces that do, the one
of least bending is taken.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FEWEST, MOST = 16, 4096
"""Levels between which plateaus are taken for banding: fewer are steps that are meant."""
FLAT = 0.05
"""Share of neighbours on one level from which a map is banded."""
JUMP = 3.0
"""Second difference, steps, up to which three pixels are one surface: rounding alone makes 2."""
SWEEPS = 60
"""Of relaxation on each lattice."""
OVER = 1.5
"""Over-relaxation."""
SMALLEST = 12
"""Pixels of the coarsest lattice's shorter side, at least."""


@dataclass(frozen=True)
class Bands:
    """What was found of banding, and what became of it.

    Parameters
    ----------
    levels : int
        Different values in the figure.
    step : float
        Between them, in the picture's own values.
    flat : float
        Share of neighbours on one level.
    repaired : bool
    flat_after : float
        Share of neighbours within a hundredth of a step.
    moved : float
        Farthest that a value was moved, steps.
    """

    levels: int
    step: float
    flat: float
    repaired: bool = False
    flat_after: float = 0.0
    moved: float = 0.0


def flat_share(values: Floats, mask: Bools, within: float) -> float:
    """Share of neighbouring pixels of the mask whose values differ by no more than `within`."""
    alike = both = 0
    for a, b in ((np.s_[:, 1:], np.s_[:, :-1]), (np.s_[1:], np.s_[:-1])):
        pair = mask[a] & mask[b]
        both += int(pair.sum())
        alike += int((np.abs(values[a] - values[b])[pair] <= within).sum())
    return alike / max(both, 1)


def find_bands(values: Floats, mask: Bools) -> Bands | None:
    """Look for plateaus.

    Parameters
    ----------
    values : (rows, cols) ndarray
    mask : (rows, cols) ndarray of bool

    Returns
    -------
    Bands or None
        None where values are too many, too few, unevenly spaced or hardly level.
    """
    levels = np.unique(values[mask])
    if not FEWEST <= len(levels) <= MOST:
        return None
    gaps = np.diff(levels)
    step = float(gaps.min())
    counts = gaps / step
    if np.abs(counts - np.rint(counts)).max() > 0.05:
        return None
    flat = flat_share(values, mask, 0.01 * step)
    return Bands(len(levels), step, flat) if flat >= FLAT else None


@kernel
def _sweep(d, low, high, mask, across, down, twist, over):  # type: ignore[no-untyped-def]
    """Relax every pixel once towards least bending, within its bounds.

    The energy is the sum of squares of second differences across and down, and
    twice those of the twist, over the groups of pixels that are one surface.
    """
    rows, cols = d.shape
    for i in range(rows):
        for j in range(cols):
            if not mask[i, j]:
                continue
            slope, bend = 0.0, 0.0
            for k in range(-1, 2):
                c = -2.0 if k == 0 else 1.0
                if across[i, j + k]:
                    m = j + k
                    slope += c * (d[i, m - 1] - 2.0 * d[i, m] + d[i, m + 1])
                    bend += c * c
                if down[i + k, j]:
                    m = i + k
                    slope += c * (d[m - 1, j] - 2.0 * d[m, j] + d[m + 1, j])
                    bend += c * c
            for a in range(2):
                for b in range(2):
                    m, n = i - a, j - b
                    if twist[m, n]:
                        c = 1.0 if a == b else -1.0
                        slope += 2.0 * c * (d[m, n] + d[m + 1, n + 1] - d[m, n + 1] - d[m + 1, n])
                        bend += 2.0
            if bend > 0.0:
                new = d[i, j] - over * slope / bend
                d[i, j] = min(max(new, low[i, j]), high[i, j])


def _groups(start: Floats, mask: Bools, step: float) -> tuple[Bools, Bools, Bools]:
    """Find groups of pixels on one surface: three in a row, three in a column, four."""
    most = JUMP * step
    across, down, twist = (np.zeros(mask.shape, bool) for _ in range(3))
    across[:, 1:-1] = mask[:, :-2] & mask[:, 1:-1] & mask[:, 2:]
    across[:, 1:-1] &= np.abs(start[:, :-2] - 2 * start[:, 1:-1] + start[:, 2:]) <= most
    down[1:-1] = mask[:-2] & mask[1:-1] & mask[2:]
    down[1:-1] &= np.abs(start[:-2] - 2 * start[1:-1] + start[2:]) <= most
    four = start[:-1, :-1] + start[1:, 1:] - start[:-1, 1:] - start[1:, :-1]
    twist[:-1, :-1] = mask[:-1, :-1] & mask[1:, 1:] & mask[:-1, 1:] & mask[1:, :-1]
    twist[:-1, :-1] &= np.abs(four) <= most
    return across, down, twist


def _coarser(values: Floats, mask: Bools) -> tuple[Floats, Bools]:
    """Halve: means of what is known of four pixels."""
    rows, cols = (n + n % 2 for n in mask.shape)
    total, count = np.zeros((2, rows, cols))
    total[: len(mask), : mask.shape[1]] = np.where(mask, values, 0.0)
    count[: len(mask), : mask.shape[1]] = mask
    total, count = (
        field.reshape(rows // 2, 2, cols // 2, 2).sum(axis=(1, 3)) for field in (total, count)
    )
    return np.divide(total, count, out=np.zeros_like(total), where=count > 0), count > 0


def _finer(values: Floats, mask: Bools, shape: tuple[int, int]) -> tuple[Floats, Bools]:
    """Bring a coarse correction to a finer lattice, from known pixels alone."""
    from scipy import ndimage

    at = np.meshgrid(*((np.arange(n) - 0.5) / 2 for n in shape), indexing="ij")
    mass = ndimage.map_coordinates(mask.astype(float), at, order=1, mode="nearest")
    total = ndimage.map_coordinates(np.where(mask, values, 0.0), at, order=1, mode="nearest")
    return np.divide(total, mass, out=np.zeros_like(total), where=mass > 0), mass > 0


def smoothest(values: Floats, mask: Bools, step: float) -> Floats:
    """Find the surface of least bending within half a step of the values.

    From coarse to fine, by projected relaxation: every sweep keeps the bounds.

    Parameters
    ----------
    values : (rows, cols) ndarray
    mask : (rows, cols) ndarray of bool
        Where they count.
    step : float

    Returns
    -------
    (rows, cols) ndarray
        |out - values| <= step / 2 in the mask, `values` outside.
    """
    mask = np.pad(mask, 2)
    values = np.pad(np.where(mask[2:-2, 2:-2], values, 0.0), 2)
    lattices = [(values, mask)]
    while min(lattices[-1][1].shape) > 2 * SMALLEST:
        coarse, known = _coarser(*lattices[-1])
        lattices.append((np.pad(coarse, 2), np.pad(known, 2)))
    moved, before = np.zeros(lattices[-1][1].shape), lattices[-1][1]
    for start, known in reversed(lattices):
        d = start.copy()
        if start.shape != moved.shape:
            inner, found = _finer(moved[2:-2, 2:-2], before[2:-2, 2:-2], start.shape)
            d += np.where(known & found, inner, 0.0)
        low, high = start - 0.5 * step, start + 0.5 * step
        d = np.clip(d, low, high)
        groups = _groups(start, known, step)
        for _ in range(SWEEPS):
            _sweep(d, low, high, known, *groups, OVER)
        moved, before = d - start, known
    return np.where(mask, d, values)[2:-2, 2:-2]


def repair(values: Floats, mask: Bools) -> tuple[Floats, Bands | None]:
    """Take the steps out of a banded map; leave any other as it is.

    Parameters
    ----------
    values : (rows, cols) ndarray
    mask : (rows, cols) ndarray of bool

    Returns
    -------
    values : (rows, cols) ndarray
    bands : Bands or None
        What was found, if it was.
    """
    found = find_bands(values, mask)
    if found is None:
        return values, None
    smooth = np.where(mask, smoothest(values, mask, found.step), values)
    after = flat_share(smooth, mask, 0.01 * found.step)
    far = float(np.abs(smooth - values)[mask].max() / found.step)
    return smooth, Bands(found.levels, found.step, found.flat, True, after, far)
