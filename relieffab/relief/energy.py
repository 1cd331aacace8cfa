"""The energy of a relief: depth, light, line and form terms on one lattice.

All terms are integrals over the figure without a unit, so that weights are
plain numbers that mean the same at any resolution:

    E = 1/A ∫ wd |∇h - g|² + ww S |∇h - g - ∇w|² + wL l² Σ |∇I(h) - ∇I0|²
              + wf ((h - f)/l)² + t l² (∂²h/∂x∂y)²

with h the height, g the compressed slopes, w the profile of the lines and S
their stencil, I the radiance under each light, f the form and l the form length
(Wang 2011, Eqs. 8, 12, 16, 19 and 20, with every term on its own scale).  The
last term, small, is there because slopes taken from four corners do not see a
checkerboard of heights.
Heights live on nodes, slopes and radiance on pixels, gradients of radiance on
nodes with four pixels of one surface around them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange

Floats = NDArray[np.float64]
Bounds = tuple[Floats | float, Floats | float]


@dataclass(frozen=True, eq=False)
class Terms:
    """Everything the energy needs, on a lattice with a border of two fixed nodes.

    Parameters
    ----------
    pitch : float
        mm.
    lights : (k, 3) ndarray
    depth_weight, line_weight : (n - 1, m - 1) ndarray
        Of each pixel's slope rows; 0 outside the figure and on occlusions, and
        that of lines away from them.
    slope : (2, n - 1, m - 1) ndarray
        Slopes asked for.
    light_weight : (n, m) ndarray
        Of each node's radiance rows, mm²; 0 where its four pixels are not one surface.
    radiance : (k, n - 1, m - 1) ndarray
        Radiance asked for, up to a constant a surface.
    twist_weight : (n - 1, m - 1) ndarray
        Of each pixel's twist, (far left - far right - near left + near right)/(2 pitch).
    form_weight : (n, m) ndarray
        1/mm²; positive on every node of the figure, 0 elsewhere.
    form : (n, m) ndarray
        mm.
    bounds : tuple of (n, m) ndarray or float
        Lowest and highest height allowed, mm; infinite for none.
    """

    pitch: float
    lights: Floats
    depth_weight: Floats
    line_weight: Floats
    slope: Floats
    light_weight: Floats
    radiance: Floats
    twist_weight: Floats
    form_weight: Floats
    form: Floats
    bounds: Bounds


@parallel_kernel
def _radiance(h, pitch, lights, p, q, radiance, dp, dq):  # type: ignore[no-untyped-def]
    """Slopes, radiance and its derivatives on every pixel."""
    rows, cols = p.shape
    for i in prange(rows):
        for j in range(cols):
            a, b, c, d = h[i, j], h[i, j + 1], h[i + 1, j], h[i + 1, j + 1]
            pp = (b + d - a - c) / (2.0 * pitch)
            qq = (a + b - c - d) / (2.0 * pitch)
            p[i, j], q[i, j] = pp, qq
            inverse = 1.0 / np.sqrt(1.0 + pp * pp + qq * qq)
            for k in range(len(lights)):
                value = (lights[k, 2] - lights[k, 0] * pp - lights[k, 1] * qq) * inverse
                radiance[k, i, j] = value
                dp[k, i, j] = -(lights[k, 0] + value * pp * inverse) * inverse
                dq[k, i, j] = -(lights[k, 1] + value * qq * inverse) * inverse


@parallel_kernel
def _residual(error, weight, pitch, rx, ry, sums):  # type: ignore[no-untyped-def]
    """Weighted gradient of the radiance's error at nodes (Eq. 8), and its energy by row."""
    rows, cols = weight.shape
    for i in prange(1, rows - 1):
        total = 0.0
        for j in range(1, cols - 1):
            w = weight[i, j]
            if w == 0.0:
                continue
            for k in range(len(error)):
                a, b = error[k, i - 1, j - 1], error[k, i - 1, j]
                c, d = error[k, i, j - 1], error[k, i, j]
                x = (b + d - a - c) / (2.0 * pitch)
                y = (a + b - c - d) / (2.0 * pitch)
                total += w * (x * x + y * y)
                rx[k, i, j], ry[k, i, j] = w * x, w * y
        sums[i] = total


@parallel_kernel
def _pull_back(  # type: ignore[no-untyped-def]
    h, p, q, asked, twist_weight, depth_weight, line_weight, rx, ry, dp, dq, pitch, gp, gq, gt, sums
):
    """Find the derivative of the energy by each pixel's slopes and twist.

    Depth and line energies come by row.
    """
    rows, cols = p.shape
    for i in prange(rows):
        depth = line = 0.0
        for j in range(cols):
            w = depth_weight[i, j] + line_weight[i, j]
            ex, ey = p[i, j] - asked[0, i, j], q[i, j] - asked[1, i, j]
            depth += depth_weight[i, j] * (ex * ex + ey * ey)
            line += line_weight[i, j] * (ex * ex + ey * ey)
            twist = (h[i, j] - h[i, j + 1] - h[i + 1, j] + h[i + 1, j + 1]) / (2.0 * pitch)
            gt[i, j] = twist_weight[i, j] * twist
            depth += gt[i, j] * twist
            along, upward = w * ex, w * ey
            for k in range(len(rx)):
                pull = (
                    rx[k, i, j]
                    + rx[k, i + 1, j]
                    - rx[k, i, j + 1]
                    - rx[k, i + 1, j + 1]
                    - ry[k, i, j]
                    - ry[k, i, j + 1]
                    + ry[k, i + 1, j]
                    + ry[k, i + 1, j + 1]
                ) / (2.0 * pitch)
                along += pull * dp[k, i, j]
                upward += pull * dq[k, i, j]
            gp[i, j], gq[i, j] = along, upward
        sums[0, i], sums[1, i] = depth, line


@parallel_kernel
def _gather(gp, gq, gt, h, form, form_weight, pitch, gradient, sums):  # type: ignore[no-untyped-def]
    """Gradient of the energy at nodes, and the form energy by row."""
    rows, cols = h.shape
    for i in prange(1, rows - 1):
        total = 0.0
        for j in range(1, cols - 1):
            w = form_weight[i, j]
            if w == 0.0:
                continue
            off = h[i, j] - form[i, j]
            total += w * off * off
            a, b, c, d = gp[i - 1, j - 1], gp[i - 1, j], gp[i, j - 1], gp[i, j]
            e, f, g, k = gq[i - 1, j - 1], gq[i - 1, j], gq[i, j - 1], gq[i, j]
            side = a - b + c - d - e - f + g + k
            side += gt[i - 1, j - 1] - gt[i - 1, j] - gt[i, j - 1] + gt[i, j]
            side /= 2.0 * pitch
            gradient[i, j] = 2.0 * (side + w * off)
        sums[i] = total


@kernel
def _slope_row(weight, twist, scale, i, first, stencil):  # type: ignore[no-untyped-def]
    """Add the couplings of one row of pixels' slopes and twists, from column `first` on."""
    width = len(weight)
    for a in range(4):
        for b in range(4):
            pp = np.float32((2 * (a % 2) - 1) * (2 * (b % 2) - 1) * scale)
            qq = np.float32((1 - 2 * (a // 2)) * (1 - 2 * (b // 2)) * scale)
            pq = np.float32(pp * qq / scale)
            o = 5 * (b // 2 - a // 2 + 2) + b % 2 - a % 2 + 2
            start = first + a % 2
            row = stencil[i + a // 2, o, start : start + width]
            for k in range(width):
                row[k] += (pp + qq) * weight[k] + pq * twist[k]


@kernel
def _radiance_rows(dp, dq, scale, i, first, rows):  # type: ignore[no-untyped-def]
    """Write the radiance's gradient at a row of nodes by the 9 heights around each.

    rows[k, 0 or 1, 3 a + b, t] is the derivative of light k's gradient in X or Y,
    at node [i, first + t], by the height of node [i + a - 1, first + t + b - 1].
    """
    rows[:] = np.float32(0.0)
    width = rows.shape[3]
    for k in range(len(dp)):
        for pixel in range(4):
            u, v = pixel // 2, pixel % 2
            start = first - 1 + v
            by_p = dp[k, i - 1 + u, start : start + width]
            by_q = dq[k, i - 1 + u, start : start + width]
            for a in range(4):
                right, up = (2 * (a % 2) - 1) * scale, (1 - 2 * (a // 2)) * scale
                place = 3 * (u + a // 2) + v + a % 2
                x, y = rows[k, 0, place], rows[k, 1, place]
                for t in range(width):
                    value = np.float32(right * by_p[t] + up * by_q[t])
                    x[t] += (2 * v - 1) * value
                    y[t] += (1 - 2 * u) * value


@kernel
def _light_row(rows, weight, i, first, stencil):  # type: ignore[no-untyped-def]
    """Add the couplings of one row of nodes' radiance gradients, from column `first` on."""
    width = len(weight)
    heavy = np.empty(width, np.float32)
    for k in range(len(rows)):
        for axis in range(2):
            for a in range(9):
                derivative = rows[k, axis, a]
                for t in range(width):
                    heavy[t] = weight[t] * derivative[t]
                for b in range(9):
                    o = 5 * (b // 3 - a // 3 + 2) + b % 3 - a % 3 + 2
                    start = first - 1 + a % 3
                    out = stencil[i + a // 3 - 1, o, start : start + width]
                    other = rows[k, axis, b]
                    for t in range(width):
                        out[t] += heavy[t] * other[t]


@kernel
def _span(weight):  # type: ignore[no-untyped-def]
    """First entry of a row that is not 0, and one past the last."""
    first, last = 0, len(weight)
    while first < last and weight[first] == 0.0:
        first += 1
    while last > first and weight[last - 1] == 0.0:
        last -= 1
    return first, last


@parallel_kernel
def _assemble(  # type: ignore[no-untyped-def]
    dp, dq, light_weight, slope_weight, twist_weight, form_weight, pitch, stencil
):
    """Gauss-Newton operator as 25 couplings a node, laid out (row, coupling, column).

    A node's radiance rows touch the nodes one row off, so rows of one colour in
    three never meet and may run side by side.
    """
    n, m = form_weight.shape
    scale = 1.0 / (4.0 * pitch * pitch)
    for colour in range(3):
        for block in prange((n - 2 - colour + 2) // 3):
            i = 1 + colour + 3 * block
            if i >= n - 1:
                continue
            for j in range(m):
                stencil[i, 12, j] += form_weight[i, j]
            first, last = _span(slope_weight[i] + twist_weight[i])
            slopes, twists = slope_weight[i, first:last], twist_weight[i, first:last]
            _slope_row(slopes, twists, scale, i, first, stencil)
            first, last = _span(light_weight[i])
            if last > first:
                rows = np.empty((len(dp), 2, 9, last - first), np.float32)
                _radiance_rows(dp, dq, scale, i, first, rows)
                _light_row(rows, light_weight[i, first:last], i, first, stencil)


@dataclass(frozen=True, eq=False)
class Linearisation:
    """The energy at one height field.

    Parameters
    ----------
    value : float
    parts : dict of float
        'depth', 'light', 'line' and 'form', adding up to `value`.
    gradient : (n, m) ndarray
        1/mm.
    derivatives : tuple of (k, n - 1, m - 1) ndarray
        Of the radiance by p and q.
    """

    value: float
    parts: dict[str, float]
    gradient: Floats
    derivatives: tuple[Floats, Floats]


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
    lights = len(terms.lights)
    p, q = np.empty((2, n - 1, m - 1))
    radiance, dp, dq = np.empty((3, lights, n - 1, m - 1))
    _radiance(h, terms.pitch, terms.lights, p, q, radiance, dp, dq)
    radiance -= terms.radiance
    rx, ry = np.zeros((2, lights, n, m))
    sums = np.zeros((4, n))
    _residual(radiance, terms.light_weight, terms.pitch, rx, ry, sums[0])
    gp, gq, gt = np.empty((3, n - 1, m - 1))
    _pull_back(
        h, p, q, terms.slope, terms.twist_weight, terms.depth_weight, terms.line_weight, rx, ry,
        dp, dq, terms.pitch, gp, gq, gt, sums[1:3],
    )  # fmt: skip
    gradient = np.zeros((n, m))
    _gather(gp, gq, gt, h, terms.form, terms.form_weight, terms.pitch, gradient, sums[3])
    light, depth, line, form = (float(row.sum()) for row in sums)
    parts = {"depth": depth, "light": light, "line": line, "form": form}
    return Linearisation(light + depth + line + form, parts, gradient, (dp, dq))


def operator(terms: Terms, linearisation: Linearisation) -> NDArray[np.float32]:
    """Half the Gauss-Newton Hessian, as couplings.

    Returns
    -------
    (n, 25, m) ndarray of float32
        Coupling o of node [i, j] is with node [i + o // 5 - 2, j + o % 5 - 2].
    """
    n, m = terms.form.shape
    stencil = np.zeros((n, 25, m), np.float32)
    dp, dq = linearisation.derivatives
    _assemble(
        dp, dq, terms.light_weight, terms.depth_weight + terms.line_weight, terms.twist_weight,
        terms.form_weight, terms.pitch, stencil,
    )  # fmt: skip
    return stencil
