"""How fast heights are found: the product, and what anyone would use instead.

    python tests/benchmarks/solver.py peers [MODEL]    time to the same energy
    python tests/benchmarks/solver.py work  [MODEL]    applications of the operator to 1e-5
    python tests/benchmarks/solver.py scale [MODEL]    time a pixel, and memory, up to 4096 x 4096
    python tests/benchmarks/solver.py huge  [MODEL]    the same at 8192 x 8192
    python tests/benchmarks/solver.py warm  [MODEL]    after one weight has changed

Peers share the energy, its gradient, its bounds and its projected Gauss-Newton
steps; each solves those steps in its own way, from the same first guess, until the
energy is what the product came to.  PyAMG is not among the project's packages:
`pip install pyamg` to see it.
"""

import contextlib
import resource
import sys
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import numpy as np
from lines import models
from numpy.typing import NDArray
from scipy import optimize, sparse
from scipy.sparse import linalg

from relieffab import named_view
from relieffab.layers.make import make_layers
from relieffab.layers.model import Layers
from relieffab.relief.bounds import hold, move, within
from relieffab.relief.edge import wall
from relieffab.relief.energy.linearise import linearise
from relieffab.relief.energy.tangent import Tangent
from relieffab.relief.energy.terms import Terms
from relieffab.relief.make import make_relief
from relieffab.relief.solve import Solution, problem, solve_heights
from relieffab.relief.targets import Carving

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Inner = Callable[[sparse.csr_matrix, Floats, Floats], Floats]

SAME = 1e-4  # of the energy: what counts as the same
PATIENCE = 900.0  # seconds after which a peer is stopped
INEXACT = 0.05  # tolerance of the peers' iterative solutions
STEPS = 60


def layers_of(path: str | None, size: tuple[float, float], resolution: tuple[int, int]) -> Layers:
    """See the model from the front."""
    mesh, up = next(models([path] if path else []))
    return make_layers(mesh, named_view("front", up), size=size, resolution=resolution)


def timed(
    layers: Layers, carving: Carving, repeats: int = 3, **more: object
) -> tuple[float, Solution]:
    """Seconds of the best run, kernels warm, and its solution."""
    edge = wall(layers.mask, layers.pitch, carving.wall_angle, carving.depth)
    best, solution = np.inf, solve_heights(layers, carving, edge, **more)  # type: ignore[arg-type]
    for _ in range(repeats):
        start = perf_counter()
        solution = solve_heights(layers, carving, edge, **more)  # type: ignore[arg-type]
        best = min(best, perf_counter() - start)
    return best, solution


def assembled(tangent: Tangent, free: Bools) -> sparse.csr_matrix:
    """Half the Gauss-Newton Hessian as a matrix, found by 25 products."""
    n, m = free.shape
    index = np.full(free.shape, -1)
    index[free] = np.arange(int(free.sum()))
    rows, cols, values = [], [], []
    out = np.zeros(free.shape)
    for colour in range(25):
        x = np.zeros(free.shape)
        x[colour // 5 :: 5, colour % 5 :: 5] = 1.0
        x *= free
        tangent.apply(x, free, out)
        # The one node of that colour that touches each row.
        i, j = np.nonzero(free)
        a = i + (colour // 5 - i + 2) % 5 - 2
        b = j + (colour % 5 - j + 2) % 5 - 2
        whole = (a >= 0) & (a < n) & (b >= 0) & (b < m)
        there = np.full(len(i), -1)
        there[whole] = index[a[whole], b[whole]]
        keep = there >= 0
        rows.append(index[i, j][keep])
        cols.append(there[keep])
        values.append(out[i, j][keep])
    return sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))))


def jacobi(matrix: sparse.csr_matrix, rhs: Floats, _: Floats) -> Floats:
    """Conjugate gradients, preconditioned by the diagonal."""
    scale = sparse.diags(1.0 / matrix.diagonal())
    return linalg.cg(matrix, rhs, rtol=INEXACT, maxiter=20_000, M=scale)[0]  # type: ignore[no-any-return]


def direct(matrix: sparse.csr_matrix, rhs: Floats, _: Floats) -> Floats:
    """SuperLU."""
    factors = linalg.splu(
        matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}
    )
    return factors.solve(rhs)  # type: ignore[no-any-return]


def algebraic(matrix: sparse.csr_matrix, rhs: Floats, smooth: Floats) -> Floats:
    """Smoothed aggregation that knows planes, as preconditioner of conjugate gradients."""
    import pyamg

    rough = pyamg.smoothed_aggregation_solver(matrix, B=smooth, max_coarse=500)
    return rough.solve(rhs, tol=INEXACT, accel="cg", maxiter=500)  # type: ignore[no-any-return]


def newton(terms: Terms, h: Floats, inner: Inner, goal: float) -> tuple[float, float]:
    """Projected Gauss-Newton steps with a peer's solver inside; seconds and energy."""
    start = perf_counter()
    here = linearise(terms, h)
    for _ in range(STEPS):
        if here.value <= goal or perf_counter() - start > PATIENCE:
            break
        free, pull, _norm = hold(here.gradient, h, terms.bounds, terms.figure)
        i, j = np.nonzero(free)
        smooth = np.stack([np.ones(len(i)), i - i.mean(), j - j.mean()], axis=1)
        step = np.zeros_like(h)
        step[free] = inner(assembled(here.tangent, free), -0.5 * pull[free], smooth)
        size = 1.0
        while True:
            new = move(h, step, size, terms.bounds)
            there = linearise(terms, new)
            if there.value < here.value or size < 1e-3:
                break
            size /= 2
        h, here = new, there
    return perf_counter() - start, here.value


def quasi_newton(terms: Terms, h: Floats, goal: float) -> tuple[float, float]:
    """SciPy's L-BFGS-B; seconds and energy."""
    start, figure, best = perf_counter(), terms.figure, [np.inf]

    class EnoughError(Exception):
        pass

    def value(x: Floats) -> tuple[float, Floats]:
        whole = np.zeros_like(h)
        whole[figure] = x
        here = linearise(terms, whole)
        best[0] = min(best[0], here.value)
        if here.value <= goal or perf_counter() - start > PATIENCE:
            raise EnoughError
        return here.value, here.gradient[figure]

    low = np.asarray(terms.bounds[0], float)[figure]
    with contextlib.suppress(EnoughError):
        optimize.minimize(
            value,
            h[figure],
            jac=True,
            method="L-BFGS-B",
            bounds=optimize.Bounds(low, terms.bounds[1]),
            options={"maxiter": 100_000, "maxfun": 1_000_000, "maxcor": 20, "ftol": 0, "gtol": 0},
        )
    return perf_counter() - start, best[0]


def peers(path: str | None, resolution: tuple[int, int] = (1024, 768)) -> None:
    """Print the time to the same energy, and the ratio to the product's."""
    layers, carving = layers_of(path, (120.0, 90.0), resolution), Carving(depth=4.0)
    seconds, solution = timed(layers, carving)
    goal = solution.energy["total"] * (1 + SAME)
    terms, _ = problem(layers, carving, solution.fitted)
    guess = within(terms.form, terms.bounds, terms.figure)
    nodes = int(terms.figure.sum())
    print(f"{resolution[0]} x {resolution[1]}, {nodes} nodes; energy {goal:.6g}")
    print(f"  {'relieffab, all of it':<34}{seconds:9.2f} s")
    ways: dict[str, Callable[[], tuple[float, float]]] = {
        "PyAMG, smoothed aggregation": lambda: newton(terms, guess, algebraic, goal),
        "SuperLU": lambda: newton(terms, guess, direct, goal),
        "Jacobi-CG": lambda: newton(terms, guess, jacobi, goal),
        "L-BFGS-B": lambda: quasi_newton(terms, guess, goal),
    }
    for name, run in ways.items():
        try:
            took, energy = run()
        except ImportError:
            print(f"  {name:<34}  not installed")
            continue
        short = "" if energy <= goal else f"  stopped at energy {energy:.6g}"
        print(f"  {name:<34}{took:9.2f} s{took / seconds:9.1f} times{short}", flush=True)


def work(path: str | None) -> None:
    """Print the operator's applications to 1e-5 on lattices that double."""
    for width in (512, 1024, 2048):
        layers = layers_of(path, (120.0, 90.0), (width, width * 3 // 4))
        seconds, s = timed(layers, Carving(depth=4.0), repeats=1, tolerance=1e-5)
        print(
            f"{width:5} wide: {s.applications} applications, {s.iterations} steps, "
            f"{s.inner} inner, residual {s.residual:.1e}, {seconds:.2f} s"
        )


def scale(path: str | None, widths: tuple[int, ...] = (1024, 2048, 4096)) -> None:
    """Print the time a pixel and the peak of memory on squares that double."""
    first = 0.0
    for width in widths:
        layers = layers_of(path, (120.0, 120.0), (width, width))
        seconds = np.inf
        for _ in range(3 if width < 4096 else 1):
            start = perf_counter()
            make_relief(layers, Carving(depth=4.0))
            seconds = min(seconds, perf_counter() - start)
        each = seconds / width**2 * 1e6
        first = first or each
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        print(
            f"{width:5} x {width}: {seconds:7.2f} s, {each:.2f} us a pixel "
            f"({each / first:.2f} times the first), peak {peak:.2f} GiB",
            flush=True,
        )


def warm(path: str | None) -> None:
    """Print the time of a new solution after one weight has changed."""
    layers, carving = layers_of(path, (120.0, 90.0), (512, 384)), Carving(depth=4.0)
    _, before = timed(layers, carving, repeats=1)
    for name in ("depth_weight", "light_weight", "line_weight", "form_weight"):
        changed = replace(carving, **{name: 1.5 * getattr(carving, name)})
        seconds, s = timed(layers, changed, start=before)
        print(
            f"{name:<13} x 1.5: {1e3 * seconds:6.1f} ms, {s.iterations} steps, "
            f"residual {s.residual:.1e}, converged {s.converged}"
        )


if __name__ == "__main__":
    kind, *rest = sys.argv[1:] or ["peers"]
    model = rest[0] if rest else None
    if kind == "huge":
        scale(model, (8192,))
    else:
        {"peers": peers, "work": work, "scale": scale, "warm": warm}[kind](model)
