"""Whether what is nearer in the model is nearer in the relief."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.quality.pair import Pair

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Points = tuple[Ints, Ints]

PAIRS = 200_000
ROUNDS = 12  # as many candidates are drawn at most, times PAIRS
NEAR = 12  # pixels
SEED = 2011


@dataclass(frozen=True)
class Order:
    """Agreement of the relief's order in depth with the model's.

    Mean of sign(dD) sign(dh) over random pairs of pixels of Ms at least a pixel's
    side apart in the model's depth: 1 if all agree, -1 if all are inverted; pairs
    at one height in the relief count 0.  NaN if there are no such pairs.

    Parameters
    ----------
    local : float
        Pairs within 12 pixels of each other on one surface: the straight way
        between them stays on pixels of Ms that no occlusion touches.
    overall : float
        Any two.
    """

    local: float
    overall: float


def one_surface(sound: Bools, a: Points, b: Points) -> Bools:
    """Tell whether the straight ways between pixels stay on sound ones.

    Parameters
    ----------
    sound : (rows, cols) ndarray of bool
    a, b : tuple of (n,) ndarray of int
        Rows and columns; at most `NEAR` pixels apart.

    Returns
    -------
    (n,) ndarray of bool
    """
    whole = sound[a] & sound[b]
    for share in (np.arange(2 * NEAR - 1) + 1) / (2 * NEAR):
        left = np.nonzero(whole)[0]
        i, j = (
            np.floor(p[left] + share * (q[left] - p[left]) + 0.5).astype(np.int64)
            for p, q in zip(a, b, strict=True)
        )
        whole[left] = sound[i, j]
    return whole


def agreement(pair: Pair, partner: Callable[[Points], tuple[Points, Bools]]) -> float:
    """Mean agreement over pairs drawn until there are enough.

    Parameters
    ----------
    pair : Pair
    partner : callable
        Pixels to a second pixel for each, and whether the two count as a pair.
    """
    rng = np.random.default_rng(SEED)
    rows, cols = np.nonzero(pair.inner)
    depth, heights = pair.layers.depth, pair.heights
    total = count = 0
    for _ in range(ROUNDS if len(rows) else 0):
        pick = rng.integers(len(rows), size=PAIRS)
        a = rows[pick], cols[pick]
        b, good = partner(a)
        nearer = depth[b] - depth[a]
        good &= np.abs(nearer) > pair.layers.pitch
        same = (np.sign(nearer) * np.sign(heights[b] - heights[a]))[good][: PAIRS - count]
        total, count = total + int(same.sum()), count + len(same)
        if count == PAIRS:
            break
    return total / count if count else float("nan")


def order(pair: Pair) -> Order:
    """Compare the order in depth of random pairs; the same ones for every relief."""
    rng = np.random.default_rng(SEED + 1)
    rows, cols = np.nonzero(pair.inner)
    shape = pair.layers.grid.shape
    reach = np.arange(-NEAR, NEAR + 1)
    down, across = np.nonzero(reach[:, None] ** 2 + reach**2 <= NEAR**2)

    def beside(a: Points) -> tuple[Points, Bools]:
        pick = rng.integers(len(down), size=PAIRS)
        i, j = a[0] + reach[down[pick]], a[1] + reach[across[pick]]
        inside = (i >= 0) & (i < shape[0]) & (j >= 0) & (j < shape[1])
        b = np.clip(i, 0, shape[0] - 1), np.clip(j, 0, shape[1] - 1)
        return b, inside & one_surface(pair.sound, a, b)

    def anywhere(_: Points) -> tuple[Points, Bools]:
        pick = rng.integers(len(rows), size=PAIRS)
        return (rows[pick], cols[pick]), np.ones(PAIRS, bool)

    return Order(agreement(pair, beside), agreement(pair, anywhere))
