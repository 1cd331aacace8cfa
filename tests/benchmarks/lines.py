"""How fast lines are drawn: the product, and its stages against a plain twin.

    python tests/benchmarks/lines.py [MODEL ...]

Every stage of the twin starts from what the fast one before it gave, so that each
is compared on the same input, and nothing is printed of a twin that disagrees.
"""

import os
import platform
import statistics
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np
import plain_curvature
import plain_jets
import plain_lines
from numpy.typing import NDArray

from relieffab import Drawing, Grid, Mesh, View, guess_up, make_mesh, read_mesh, scarab
from relieffab.errors import InputError
from relieffab.layers.lines.chains import Chains, resample
from relieffab.layers.lines.contours import (
    contours,
    radial_curvature,
    radial_derivative,
    suggestive,
)
from relieffab.layers.lines.creases import find_creases
from relieffab.layers.lines.curvature import Curvature, curvature
from relieffab.layers.lines.edges import find_edges
from relieffab.layers.lines.jets import osculate
from relieffab.layers.lines.strokes import draw_strokes
from relieffab.layers.lines.surface import Surface, prepare
from relieffab.layers.lines.visibility import visible
from relieffab.layers.raster import Raster, rasterise
from relieffab.layers.view import Placed, place
from relieffab.subject.shapes import sheet

Floats = NDArray[np.float64]
Lines = tuple[Chains, Chains]

SIZE = (120.0, 90.0)
RESOLUTION = (1024, 768)
MARGIN = 6.0
REPEATS = 5
AGREEMENT = 1e-6
"""Relative difference from the twin that rounding may explain."""
ROW = "  {:<38}{:>12}{:>12}{:>12}"


@dataclass(frozen=True, eq=False)
class Stage:
    """A stage that has a twin: ms of both."""

    name: str
    fast: float
    plain: float


def knot(counts: tuple[int, int] = (1000, 40)) -> Mesh:
    """Make a tube along the (2, 3) torus knot of radii 3 and 1."""

    def course(t: Floats) -> Floats:
        rho = 3 + np.cos(3 * t)
        return np.stack([rho * np.cos(2 * t), rho * np.sin(2 * t), np.sin(3 * t)], axis=1)

    def surface(u: Floats, v: Floats) -> Floats:
        t, phi = 2 * np.pi * u, 2 * np.pi * v[:, None]
        along = course(t + 1e-4) - course(t - 1e-4)
        aside = np.cross(along, np.cross([0.0, 0.0, 1.0], along))
        aside /= np.linalg.norm(aside, axis=1, keepdims=True)
        level = np.cross(along, aside)
        level /= np.linalg.norm(level, axis=1, keepdims=True)
        return course(t) + 0.5 * (np.cos(phi) * level + np.sin(phi) * aside)

    return make_mesh(*sheet(surface, counts, closed=(True, True)), name="knot")


def models(paths: list[str]) -> Iterator[tuple[Mesh, str]]:
    """Read the models named, or make two of some 40,000 vertices; tell which axis is up."""
    for path in paths:
        mesh = read_mesh(path)
        yield mesh, guess_up(mesh)
    if not paths:
        yield make_mesh(*scarab(cell=0.6), name="scarab"), "y"
        yield knot(), "y"


def timed(work: Callable[[], Any], times: int = REPEATS) -> tuple[Any, list[float]]:
    """Return what work gives and how long it took each time, ms."""
    took = []
    for _ in range(times):
        start = perf_counter()
        result = work()
        took.append(1000 * (perf_counter() - start))
    return result, took


def time_product(mesh: Mesh, placed: Placed, grid: Grid) -> Raster:
    """Print how long the pixels and the strokes of a model take."""
    rasterise(placed.vertices, placed.faces, grid)
    raster, pixels = timed(lambda: rasterise(placed.vertices, placed.faces, grid))
    draw_strokes(placed, raster, grid)
    strokes, drawing = timed(lambda: draw_strokes(placed, raster, grid))
    vertices, faces = len(placed.vertices), len(placed.faces)
    print(f"\n{mesh.name}: {vertices} vertices, {faces} faces, {len(strokes)} strokes")
    print(ROW.format("product, ms", "best", "median", ""))
    for name, took in (("rasterise", pixels), ("draw_strokes", drawing)):
        print(ROW.format(name, f"{min(took):.1f}", f"{statistics.median(took):.1f}", ""))
    return raster


def unfaired(placed: Placed) -> Surface:
    """Part a model at its creases and take no detail off."""
    edges = find_edges(placed.faces, len(placed.solid))
    creases = find_creases(placed.solid, placed.faces, edges, Drawing().min_length)
    return prepare(placed.solid, placed.faces, creases, edges, detail=0.0, eye=placed.eye)


def compare_curvature(surface: Surface) -> tuple[Stage, Curvature]:
    """Time the averages of the faces' curvature and its derivative."""
    mesh = surface.vertices, surface.faces
    fast, took = timed(lambda: curvature(*mesh))
    twin, once = timed(lambda: plain_curvature.curvature(*mesh), times=1)
    expect_same_bend("", surface, fast, twin)
    return Stage("curvature, derivative", min(took), once[0]), fast


def compare_jets(surface: Surface, rough: Curvature) -> Stage:
    """Time the cubics that better them."""
    mesh = surface.vertices, surface.faces
    fast, took = timed(lambda: osculate(surface.vertices, surface.edges, rough))
    twin, once = timed(lambda: plain_jets.osculate(*mesh, rough), times=1)
    expect_same_bend(" of the cubics", surface, fast, twin)
    return Stage("osculating cubics", min(took), once[0])


def expect_same_bend(of: str, surface: Surface, fast: Curvature, twin: Curvature) -> None:
    """Check all that does not depend on a choice of frame."""
    ours = replace(surface, bend=fast)
    radial = [plain_lines.radial(twin, vertex) for vertex in range(len(twin.areas))]
    bending, change = np.array(radial).T
    expect_alike("normals" + of, fast.normals.T, twin.normals.T)
    expect_alike("areas" + of, fast.areas, twin.areas)
    expect_alike("k1, k2" + of, *(np.sort(b.principal, axis=0) for b in (fast, twin)))
    expect_alike("radial curvature" + of, radial_curvature(ours), bending)
    expect_alike("radial derivative" + of, radial_derivative(ours), change)


def find_lines(surface: Surface) -> Lines:
    """Find contours and suggestive contours on a mesh whose edges are not known yet."""
    edges = find_edges(surface.faces, len(surface.vertices))
    surface = replace(surface, edges=edges)
    return contours(surface), suggestive(surface)


def find_lines_plainly(surface: Surface) -> Lines:
    """Find the same lines as the twin does."""
    mesh = surface.vertices, surface.faces, surface.bend
    return (
        plain_lines.contours(*mesh, surface.radius),
        plain_lines.suggestive_contours(*mesh, surface.size),
    )


def compare_lines(surface: Surface) -> tuple[Stage, Lines]:
    """Time zero sets and chaining; check number, length and strength of the chains."""
    fast, took = timed(lambda: find_lines(surface))
    twin, once = timed(lambda: find_lines_plainly(surface), times=1)
    for name, ours, theirs in zip(("contours", "suggestive contours"), fast, twin, strict=True):
        expect_alike(f"number, lengths of {name}", measure(ours), measure(theirs))
    return Stage("zero sets, chains", min(took), once[0]), fast


def measure(chains: Chains) -> Floats:
    """Number of chains, their length and the part of it that has strength, mm: (3, 1)."""
    within = np.ones(max(len(chains.points) - 1, 0), bool)
    within[chains.begin[1:-1] - 1] = False
    length = np.linalg.norm(np.diff(chains.points, axis=0), axis=1)[within]
    strength = (chains.strength[1:] + chains.strength[:-1])[within] / 2
    return np.array([[len(chains.begin) - 1], [length.sum()], [(length * strength).sum()]])


def compare_visibility(lines: Lines, raster: Raster, grid: Grid) -> Stage:
    """Time the depth test of sampled lines; check that both see the same points."""
    fine = [resample(chains, grid.pitch) for chains in lines]
    fast, took = timed(lambda: [visible(chains, raster.depth, grid) for chains in fine])
    twin, once = timed(lambda: [plain_lines.visible(c, raster.depth, grid) for c in fine], times=1)
    differ = int((np.concatenate(fast) != np.concatenate(twin)).sum())
    if differ:
        sys.exit(f"the twin disagrees: {differ} points are seen by one and not by the other")
    return Stage("visibility", min(took), once[0])


def expect_alike(name: str, fast: Floats, twin: Floats) -> None:
    """Stop if values (..., n) differ from a twin's by more than rounding, or are none."""
    scale = np.maximum(np.abs(twin), np.abs(twin).mean(axis=-1, keepdims=True))
    worse = ~(np.abs(fast - twin) <= AGREEMENT * scale)  # what is not a number is worse
    if worse.any():
        at = tuple(int(i) for i in np.argwhere(worse)[0])
        sys.exit(
            f"the twin disagrees: {name}: {int(worse.sum())} of {worse.size} values, "
            f"the first {fast[at]!r} against its {twin[at]!r} at {at}"
        )


def print_ratios(stages: list[Stage]) -> None:
    """Print what each stage takes, fast and plain, and all of them together."""
    total = Stage("total", sum(s.fast for s in stages), sum(s.plain for s in stages))
    print(ROW.format("stage, ms", "fast", "plain", "plain/fast"))
    for stage in (*stages, total):
        ratio = f"{stage.plain / stage.fast:.0f}"
        print(ROW.format(stage.name, f"{stage.fast:.1f}", f"{stage.plain:.0f}", ratio))


def benchmark(mesh: Mesh, up: str) -> None:
    """Print the tables of one model."""
    placed = place(mesh, View(up=up), SIZE, margin=MARGIN)
    grid = Grid.on_panel(SIZE, RESOLUTION)
    raster = time_product(mesh, placed, grid)
    surface = unfaired(placed)
    bending, rough = compare_curvature(surface)
    fitting = compare_jets(surface, rough)
    drawing, lines = compare_lines(surface)
    print_ratios([bending, fitting, drawing, compare_visibility(lines, raster, grid)])


def main(paths: list[str]) -> None:
    """Print a header and the tables of every model."""
    print(
        f"{os.cpu_count()} cores, Python {platform.python_version()}, NumPy {np.__version__}; "
        f"panel {SIZE[0]:g} x {SIZE[1]:g} mm at {RESOLUTION[0]} x {RESOLUTION[1]}, "
        f"best of {REPEATS}, the twin once"
    )
    try:
        for mesh, up in models(paths):
            benchmark(mesh, up)
    except InputError as fault:
        sys.exit(str(fault))


if __name__ == "__main__":
    main(sys.argv[1:])
