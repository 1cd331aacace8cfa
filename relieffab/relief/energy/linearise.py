"""The energy of one height field and its gradient.

    E = 1/A ∫ wd |∇h - g|² + ww S |∇h - g - ∇w|² + wL l² Σ |∇(I(h) - I0)|²
              + wf ((h - f)/l)² + t (½ pitch ∂²h/∂x∂y)²

with h the height, g the compressed slopes, w the profile of the lines and S
their stencil, I the radiance under each light and I0 what is asked of it, f the form
and l the form length
(Wang 2011, Eqs. 8, 12, 16, 19 and 20, with every term on its own scale, so that
weights are plain numbers that mean the same at any resolution).  The last term,
small, is there because slopes taken from four corners do not see a checkerboard
of heights; it counts as depth.

Where the radiance asked for is that of the slopes asked for, I(h) - I0 is taken to
first order around those, or gentler ones of their direction: the energy is quadratic
then, and its minimum the only one.
  Heights live on nodes, slopes and radiance on
pixels, gradients of radiance on nodes with four pixels of one surface around them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.relief.energy.rows import (
    DEPTH,
    FORM,
    HALF,
    LIGHT,
    LINE,
    TWIST,
    buffers,
    gather,
    pull,
    push,
    tilt,
)
from relieffab.relief.energy.tangent import Tangent
from relieffab.relief.energy.terms import ROWS, Terms, asked, spans

Floats = NDArray[np.float64]

MILD = 0.5
"""Steepest slope around which radiance is taken to first order: that of a surface which
faces a light does not change with its slope, and would leave it to chance."""


@kernel
def _strain(h, weighing, asked_slope, c, i, lo, width, b, slope, rise):  # type: ignore[no-untyped-def]
    """Slopes of pixel row i, and their weighed errors."""
    one, two = h[i, lo : lo + width], h[i, lo + 1 : lo + 1 + width]
    three, four = h[i + 1, lo : lo + width], h[i + 1, lo + 1 : lo + 1 + width]
    inside, ink = weighing.mask[i, lo : lo + width], weighing.stencil[i, lo : lo + width]
    gx, gy = asked_slope[0, i, lo : lo + width], asked_slope[1, i, lo : lo + width]
    u, v, t = b.u[i % 3], b.v[i % 3], b.t[i % 3]
    half, depth, line = c[HALF], c[DEPTH], c[LINE]
    for k in range(width):
        slope[k] = half * ((two[k] - three[k]) + (four[k] - one[k]))
        rise[k] = half * ((two[k] - three[k]) - (four[k] - one[k]))
    for k in range(width):
        w = ((depth if inside[k] else 0.0) + line * ink[k]) / (2.0 * half)
        u[k] = w * ((slope[k] - gx[k]) - (rise[k] - gy[k]))
        v[k] = w * ((slope[k] - gx[k]) + (rise[k] - gy[k]))
    for k in range(width):
        bend = (one[k] + four[k]) - (two[k] + three[k])
        t[k] = c[TWIST] * bend if inside[k] else 0.0


@kernel
def _energy(inside, ink, c, i, b):  # type: ignore[no-untyped-def]
    """Depth and line energy of pixel row i, from its weighed errors."""
    u, v, t = b.u[i % 3], b.v[i % 3], b.t[i % 3]
    depth = line = 0.0
    for k in range(len(ink)):
        first = c[DEPTH] if inside[k] else 0.0
        w = first + c[LINE] * ink[k]
        square = (u[k] * u[k] + v[k] * v[k]) / (w * w) if w > 0.0 else 0.0
        depth += first * square
        line += c[LINE] * ink[k] * square
        depth += t[k] * t[k] / c[TWIST] if c[TWIST] > 0.0 else 0.0
    return depth, line


@kernel
def _shine(slope, rise, lights, radiance, i, lo, b):  # type: ignore[no-untyped-def]
    """Find the error of the radiance on pixel row i."""
    width = len(slope)
    for j in range(len(lights)):
        lx, ly, lz = lights[j, 0], lights[j, 1], lights[j, 2]
        wanted, change = radiance[j, i, lo : lo + width], b.change[i % 2, j]
        for k in range(width):
            change[k] = (lz - lx * slope[k] - ly * rise[k]) * b.inverse[k] - wanted[k]


@kernel
def _gentle(gx, gy, x, y):  # type: ignore[no-untyped-def]
    """Shorten slopes steeper than `MILD`."""
    for k in range(len(x)):
        size = max(np.sqrt(gx[k] * gx[k] + gy[k] * gy[k]) / MILD, 1.0)
        x[k], y[k] = gx[k] / size, gy[k] / size


@kernel
def _near(slope, rise, wanted, c, i, lo, b):  # type: ignore[no-untyped-def]
    """Find the error of the radiance on pixel row i to first order from the slopes asked for."""
    width = len(slope)
    gx, gy = wanted[0, i, lo : lo + width], wanted[1, i, lo : lo + width]
    whole = 1.0 / (2.0 * c[HALF])
    for j in range(b.change.shape[1]):
        along, across, change = b.along[i % 2, j], b.across[i % 2, j], b.change[i % 2, j]
        for k in range(width):
            x, y = whole * (slope[k] - gx[k]), whole * (rise[k] - gy[k])
            change[k] = along[k] * (x - y) + across[k] * (x + y)


@kernel
def _light(b, c, i):  # type: ignore[no-untyped-def]
    """Light energy of node row i, from its weighed differences."""
    total = 0.0
    for j in range(b.change.shape[1]):
        falling, rising = b.falling[i % 2, j], b.rising[i % 2, j]
        for k in range(len(falling)):
            total += falling[k] * falling[k] + rising[k] * rising[k]
    return total / c[LIGHT] if c[LIGHT] > 0.0 else 0.0


@kernel
def _off(h, form, figure, c, total, gradient):  # type: ignore[no-untyped-def]
    """Finish a row of the gradient; returns its form energy."""
    energy = 0.0
    for k in range(1, len(h)):
        gradient[k] = 2.0 * (total[k] - c[FORM] * form[k]) if figure[k] else 0.0
        off = h[k] - form[k] if figure[k] else 0.0
        energy += off * off
    return c[FORM] * energy


@parallel_kernel
def _linearise(  # type: ignore[no-untyped-def]
    h, weighing, wanted, radiance, figure, form, lights, c, places, p, q, gradient, sums
):
    """Slopes, gradient and, by row, depth, light, line and form energy."""
    n = len(h)
    near = len(radiance) == 0
    for block in prange(len(places)):
        first, lo, hi = 2 + block * ROWS, places[block, 0], places[block, 1]
        width, last = hi - lo, min(first + ROWS, n - 2)
        b = buffers(len(lights), width, h)
        slope, rise, around = np.empty(width), np.empty(width), np.empty((2, width))
        for i in range(first - 2, last + 1 if width > 0 else 0):
            own = first <= i < last
            _strain(h, weighing, wanted, c, i, lo, width, b, slope, rise)
            if near:
                _gentle(wanted[0, i, lo:hi], wanted[1, i, lo:hi], around[0], around[1])
                tilt(around[0], around[1], lights, c, i, b)
                _near(slope, rise, wanted, c, i, lo, b)
            else:
                tilt(slope, rise, lights, c, i, b)
                _shine(slope, rise, lights, radiance, i, lo, b)
            if own:
                if near:
                    p[i, lo:hi], q[i, lo:hi] = around[0], around[1]
                else:
                    p[i, lo:hi], q[i, lo:hi] = slope, rise
                sums[i, 0], sums[i, 2] = _energy(
                    weighing.mask[i, lo:hi], weighing.stencil[i, lo:hi], c, i, b
                )
            if i >= first - 1:
                pull(weighing, c, i, lo, width, b)
                if own:
                    sums[i, 1] = _light(b, c, i)
            if i >= first:
                push(i - 1, width, b)
            if i > first:
                gather(h, c, i - 1, lo, width, b)
                sums[i - 1, 3] = _off(
                    h[i - 1, lo:hi], form[i - 1, lo:hi], figure[i - 1, lo:hi], c, b.total,
                    gradient[i - 1, lo:hi],
                )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Linearisation:
    """The energy at one height field.

    Parameters
    ----------
    value : float
    parts : dict of float
        'depth', 'light', 'line' and 'form', adding up to `value`.
    gradient : (n, m) ndarray
        1/mm; 0 on nodes outside the figure.
    tangent : Tangent
        Half the Gauss-Newton Hessian.
    """

    value: float
    parts: dict[str, float]
    gradient: Floats
    tangent: Tangent


def linearise(terms: Terms, h: Floats) -> Linearisation:
    """Evaluate the energy and its exact gradient.

    Parameters
    ----------
    terms : Terms
    h : (n, m) ndarray
        Heights, mm.

    Returns
    -------
    Linearisation
    """
    n, m = h.shape
    p, q = np.zeros((2, n - 1, m - 1), np.float32)
    radiance = terms.radiance
    if radiance is None:
        radiance = np.zeros((0, n - 1, m - 1), np.float32)
    gradient, sums = np.zeros((n, m)), np.zeros((n, 4))
    _linearise(
        h, asked(terms), terms.slope, radiance, terms.figure, terms.form, terms.lights,
        terms.constants(np.float64), spans(terms.figure), p, q, gradient, sums,
    )  # fmt: skip
    depth, light, line, form = (float(part) for part in sums.sum(axis=0))
    parts = {"depth": depth, "light": light, "line": line, "form": form}
    return Linearisation(depth + light + line + form, parts, gradient, Tangent(terms, p, q))
