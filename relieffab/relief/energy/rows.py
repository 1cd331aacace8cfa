"""Rows of pixels and nodes: the steps that the energy's kernels are made of.

Slopes of a pixel are taken along its diagonals, from its four corner heights

    a  b        U = d - a        p = (V + U) / (2 pitch)
    c  d        V = b - c        q = (V - U) / (2 pitch)

and gradients of radiance at a node along the diagonals of its four pixels, which
leaves fewer sums than along the axes, and the same energies.

A block of rows is swept from the far to the near edge with buffers of two or
three rows, numbered by the row's index modulo their count:

    pixel row i      (`strain`, `shine`)     from node rows i, i + 1
    node row i       (`pull`)                from pixel rows i - 1, i
    pixel row i - 1  (`push`)                from node rows i - 1, i
    node row i - 1   (`gather`)              from pixel rows i - 2, i - 1

Constants come packed as [1 / (2 pitch), depth, line, twist, light, form, exact, 1],
the weights times what the diagonals and the pitch make of them.
"""

from typing import Any, NamedTuple

import numpy as np

from relieffab.compiled import kernel

HALF, DEPTH, LINE, TWIST, LIGHT, FORM, EXACT, ONE = range(8)


class Buffers(NamedTuple):
    """Rows under way.

    Parameters
    ----------
    along, across : (2, k, width) ndarray
        Derivative of the radiance by U and V.
    change : (2, k, width) ndarray
        Radiance, or its error.
    falling, rising : (2, k, width) ndarray
        Weighted difference of radiance along a node's diagonals.
    u, v, t : (3, width) ndarray
        Half the energy's derivative by U, V and a pixel's twist.
    inverse : (width,) ndarray
        1 / sqrt(1 + p² + q²).
    total : (width,) ndarray
        The finished row.
    """

    along: Any
    across: Any
    change: Any
    falling: Any
    rising: Any
    u: Any
    v: Any
    t: Any
    inverse: Any
    total: Any


@kernel
def buffers(lights, width, like):  # type: ignore[no-untyped-def]
    """Make buffers of zeros, of the type of `like`."""
    two, three = (2, lights, width), (3, width)
    return Buffers(
        np.zeros(two, like.dtype), np.zeros(two, like.dtype), np.zeros(two, like.dtype),
        np.zeros(two, like.dtype), np.zeros(two, like.dtype), np.zeros(three, like.dtype),
        np.zeros(three, like.dtype), np.zeros(three, like.dtype),
        np.zeros(width, like.dtype), np.zeros(width, like.dtype),
    )  # fmt: skip


@kernel
def strain(x, asked, c, i, lo, width, b):  # type: ignore[no-untyped-def]
    """Weigh the slopes and twists of pixel row i."""
    nothing = c[0] - c[0]
    depth, line, twist = c[DEPTH], c[LINE], c[TWIST]
    one, two = x[i, lo : lo + width], x[i, lo + 1 : lo + 1 + width]
    three, four = x[i + 1, lo : lo + width], x[i + 1, lo + 1 : lo + 1 + width]
    inside, ink = asked.mask[i, lo : lo + width], asked.stencil[i, lo : lo + width]
    u, v, t = b.u[i % 3], b.v[i % 3], b.t[i % 3]
    for k in range(width):
        w = (depth if inside[k] else nothing) + line * ink[k]
        u[k] = w * (four[k] - one[k])
        v[k] = w * (two[k] - three[k])
    for k in range(width):
        bend = (one[k] + four[k]) - (two[k] + three[k])
        t[k] = twist * bend if inside[k] else nothing


@kernel
def tilt(slope, rise, lights, c, i, b):  # type: ignore[no-untyped-def]
    """Find the derivative of the radiance by U and V from the slopes of pixel row i."""
    half, exact, one = c[HALF], c[EXACT], c[ONE]
    inverse = b.inverse
    for k in range(len(slope)):
        inverse[k] = one / np.sqrt(one + slope[k] * slope[k] + rise[k] * rise[k])
    for j in range(len(lights)):
        lx, ly, lz = lights[j, 0], lights[j, 1], lights[j, 2]
        along, across = b.along[i % 2, j], b.across[i % 2, j]
        for k in range(len(slope)):
            inv = inverse[k]
            value = exact * (lz - lx * slope[k] - ly * rise[k]) * inv * inv
            by_p = (lx + value * slope[k]) * inv
            by_q = (ly + value * rise[k]) * inv
            along[k] = half * (by_q - by_p)
            across[k] = -half * (by_q + by_p)


@kernel
def shine(x, i, lo, width, b):  # type: ignore[no-untyped-def]
    """Find the change of radiance on pixel row i from a change x of heights."""
    one, two = x[i, lo : lo + width], x[i, lo + 1 : lo + 1 + width]
    three, four = x[i + 1, lo : lo + width], x[i + 1, lo + 1 : lo + 1 + width]
    for j in range(b.change.shape[1]):
        along, across, change = b.along[i % 2, j], b.across[i % 2, j], b.change[i % 2, j]
        for k in range(width):
            change[k] = along[k] * (four[k] - one[k]) + across[k] * (two[k] - three[k])


@kernel
def pull(asked, c, i, lo, width, b):  # type: ignore[no-untyped-def]
    """Weigh the differences of radiance along the diagonals of node row i."""
    nothing, weight = c[0] - c[0], c[LIGHT]
    whole = asked.whole[i, lo : lo + width]
    for j in range(b.change.shape[1]):
        far, near = b.change[(i - 1) % 2, j], b.change[i % 2, j]
        falling, rising = b.falling[i % 2, j], b.rising[i % 2, j]
        for k in range(1, width):
            w = weight if whole[k] else nothing
            falling[k] = w * (near[k] - far[k - 1])
            rising[k] = w * (far[k] - near[k - 1])


@kernel
def push(i, width, b):  # type: ignore[no-untyped-def]
    """Add what the radiance around them asks of the slopes of pixel row i."""
    u, v = b.u[i % 3], b.v[i % 3]
    here, below = i % 2, (i + 1) % 2
    for j in range(b.change.shape[1]):
        falling, under = b.falling[here, j], b.falling[below, j]
        rising, lower = b.rising[here, j], b.rising[below, j]
        along, across = b.along[here, j], b.across[here, j]
        for k in range(width - 1):
            asks = (falling[k] - under[k + 1]) + (lower[k] - rising[k + 1])
            u[k] += along[k] * asks
            v[k] += across[k] * asks


@kernel
def gather(x, c, i, lo, width, b):  # type: ignore[no-untyped-def]
    """Bring slopes, twists and form together in `total` on node row i."""
    form = c[FORM]
    here = x[i, lo : lo + width]
    u, under = b.u[(i - 1) % 3], b.u[i % 3]
    v, lower = b.v[(i - 1) % 3], b.v[i % 3]
    t, bent = b.t[(i - 1) % 3], b.t[i % 3]
    for k in range(1, width):
        sides = (u[k - 1] - under[k]) + (lower[k - 1] - v[k])
        twists = (t[k - 1] + bent[k]) - (t[k] + bent[k - 1])
        b.total[k] = sides + twists + form * here[k]
