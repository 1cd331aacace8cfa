"""How a height field becomes a solid: the product, and what anyone would use instead.

    python tests/benchmarks/panel.py peers [MODEL]    error and time at one count of triangles
    python tests/benchmarks/panel.py scale [MODEL]    to a written STL, up to 4096 x 3072

Every error is the largest vertical distance at any point, measured by the product's
`deviations`; beside it stands the 99th percentile over triangles, since one bad wall
should not hide the rest.  Trimesh's decimation is fast-simplification's with its own
settings.  pydelatin, a greedy triangulation too, and PyMeshLab, which looks for
self-intersections, are not among the project's packages: `pip install pydelatin
pymeshlab` to see them.
"""

import contextlib
import resource
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import fast_simplification
import manifold3d
import numpy as np
import trimesh
from numpy.typing import NDArray
from solver import layers_of

from relieffab.panel.carve import make_panel
from relieffab.panel.deviate import deviations
from relieffab.panel.export import write_stl
from relieffab.panel.model import Panel
from relieffab.relief.make import make_relief
from relieffab.relief.model import Relief
from relieffab.relief.targets import Carving
from relieffab.stock import Stock

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Triangles = tuple[Floats, Ints]  # columns, rows and heights in mm; node numbers

SIZE, THICKNESS, DEPTH, TOLERANCE = (120.0, 90.0), 12.0, 4.0, 0.02


def relief_of(path: str | None, resolution: tuple[int, int]) -> Relief:
    """Carve the model from the front."""
    return make_relief(layers_of(path, SIZE, resolution), Carving(depth=DEPTH))[0]


def written(relief: Relief, folder: Path) -> tuple[Panel, float]:
    """Seconds from the height field to a written STL, and the panel."""
    start = perf_counter()
    panel = make_panel(relief, Stock(*SIZE, THICKNESS), tolerance=TOLERANCE)
    write_stl(panel, folder / "panel.stl")
    return panel, perf_counter() - start


def every_pixel(relief: Relief) -> Triangles:
    """Two triangles a pixel."""
    h = relief.heights
    row, col = np.divmod(np.arange(h.size), h.shape[1])
    a = np.arange(h.size).reshape(h.shape)[:-1, :-1].ravel()
    c, d = a + h.shape[1], a + h.shape[1] + 1
    faces = np.concatenate([np.stack([a, c, d], axis=1), np.stack([a, d, a + 1], axis=1)])
    return np.stack([col, row, h.ravel()], axis=1).astype(float), faces


def quadrics(whole: Triangles, count: int, pitch: float, agg: float) -> Triangles:
    """fast-simplification."""
    vertices, faces = whole
    scale = np.array([pitch, pitch, 1.0])
    found, left = fast_simplification.simplify(
        vertices * scale, faces.astype(np.int32), target_count=count, agg=agg
    )
    return found / scale, left.astype(np.int64)


def decimated(whole: Triangles, count: int, pitch: float) -> Triangles:
    """Trimesh's decimation, as it comes."""
    scale = np.array([pitch, pitch, 1.0])
    mesh = trimesh.Trimesh(whole[0] * scale, whole[1], process=False)
    mesh = mesh.simplify_quadric_decimation(face_count=count)
    return np.asarray(mesh.vertices) / scale, np.asarray(mesh.faces, np.int64)


def modelled(relief: Relief, tolerance: float) -> Triangles:
    """Manifold's simplify, on the slab with two triangles a pixel."""
    vertices, faces = every_pixel(relief)
    n, pitch = len(vertices), relief.grid.pitch
    edges = trimesh.Trimesh(vertices, faces, process=False)
    rim = edges.edges[trimesh.grouping.group_rows(edges.edges_sorted, require_count=1)]
    walls = [
        np.stack([rim[:, 1], rim[:, 0], rim[:, 0] + n], axis=1),
        np.stack([rim[:, 1], rim[:, 0] + n, rim[:, 1] + n], axis=1),
    ]
    low = vertices * (1, 1, 0) - (0, 0, THICKNESS)
    points = np.concatenate([vertices, low]) * (pitch, pitch, -1.0)
    shell = np.concatenate([faces, faces[:, ::-1] + n, *walls])
    solid = manifold3d.Manifold(manifold3d.Mesh64(points, shell.astype(np.uint64)))
    mesh = solid.simplify(tolerance).to_mesh64()
    found = np.array(mesh.vert_properties[:, :3]) / (pitch, pitch, -1.0)
    left = np.array(mesh.tri_verts, np.int64)
    return found, left[(found[left, 2] > -THICKNESS / 2).all(axis=1)]


def greedy(relief: Relief) -> Triangles:
    """pydelatin, which looks at nodes only."""
    from pydelatin import Delatin

    tin = Delatin(relief.heights.astype(np.float32), max_error=TOLERANCE)
    # Its rows run upwards.
    return tin.vertices * (1, -1, 1) + (0, len(relief.heights) - 1, 0), tin.triangles.astype(int)


def peers(path: str | None) -> None:
    """Print each peer's error and time at our count of triangles."""
    relief = relief_of(path, (1024, 768))
    with tempfile.TemporaryDirectory() as folder:
        written(relief, Path(folder))
        panel, seconds = written(relief, Path(folder))
    whole, pitch = every_pixel(relief), relief.grid.pitch
    count = len(panel.faces)
    share = 100 * count / len(whole[1])
    print(f"ours, written: {count} triangles, {share:.2f} % of {len(whole[1])}, "
          f"largest error {panel.max_error_mm:.4f} mm, {seconds:.2f} s")  # fmt: skip
    runs: dict[str, Callable[[], Triangles]] = {
        "fast-simplification, agg 7": lambda: quadrics(whole, count, pitch, 7.0),
        "fast-simplification, agg 3": lambda: quadrics(whole, count, pitch, 3.0),
        "trimesh": lambda: decimated(whole, count, pitch),
        "manifold3d, simplify(0.02)": lambda: modelled(relief, TOLERANCE),
        "pydelatin, 0.02": lambda: greedy(relief),
    }
    for name, run in runs.items():
        with contextlib.suppress(ImportError):
            start = perf_counter()
            vertices, faces = run()
            took = perf_counter() - start
            gaps = deviations(relief.heights, vertices, faces)
            print(f"{name:<28} {len(faces):7} triangles, largest error {gaps.max():.4f} mm "
                  f"({gaps.max() / panel.max_error_mm:.0f} times ours), "
                  f"99 % within {np.percentile(gaps, 99):.4f} mm, {took:.2f} s "
                  f"({took / seconds:.2f} times ours)", flush=True)  # fmt: skip
    intersections(panel)


def intersections(panel: Panel) -> None:
    """Print what PyMeshLab finds wrong with the panel."""
    with contextlib.suppress(ImportError):
        import pymeshlab

        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(panel.vertices, panel.faces.astype(np.int32)))
        meshes.compute_selection_by_self_intersections_per_face()
        print("PyMeshLab:", meshes.current_mesh().selected_face_number(), "triangles intersect,",
              meshes.get_topological_measures())  # fmt: skip


def scale(path: str | None) -> None:
    """Print time and memory from height field to written STL on grids that double."""
    for width in (1024, 2048, 4096):
        relief = relief_of(path, (width, width * 3 // 4))
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        with tempfile.TemporaryDirectory() as folder:
            panel, seconds = min(
                (written(relief, Path(folder)) for _ in range(2)), key=lambda run: run[1]
            )
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        print(f"{width:5} x {width * 3 // 4}: {seconds:6.2f} s, {len(panel.faces)} triangles, "
              f"largest error {panel.max_error_mm:.4f} mm, peak {peak:.2f} GiB "
              f"(the relief took {before:.2f})", flush=True)  # fmt: skip


if __name__ == "__main__":
    kind, *rest = sys.argv[1:] or ["peers"]
    {"peers": peers, "scale": scale}[kind](rest[0] if rest else None)
