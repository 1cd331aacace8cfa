"""Looks: what was worked out, as frames for the page."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.job import reliefs, styles
from relieffab.job.settings import Job
from relieffab.layers.content import MESH
from relieffab.layers.mesh import Mesh
from relieffab.layers.model import Layers, Stroke
from relieffab.panel.model import Panel
from relieffab.relief.targets import line_depth
from relieffab.relief.window import figure_size
from relieffab.studio.frames import pack
from relieffab.studio.sheet import Sheet
from relieffab.studio.solved import Solved, View
from relieffab.studio.trial import Run, Trial, Tried
from relieffab.toolpath.plan import NAMES

KINDS = ("rapid", *NAMES)


def mesh_frame(mesh: Mesh) -> bytes:
    """Show a model, in its own units."""
    arrays = {
        "positions": mesh.vertices.astype(np.float32),
        "indices": mesh.faces.astype(np.uint32),
    }
    return pack({"triangles": len(mesh.faces)}, arrays)


def sheet_frame(sheet: Sheet) -> bytes:
    """Show a picture or an SVG, in its own pixels or units."""
    return pack({"picture": True, "box": sheet.box}, {"colours": sheet.shown})


def _bytes(image: NDArray[np.float64]) -> NDArray[np.uint8]:
    return np.rint(255 * np.clip(image, 0.0, 1.0)).astype(np.uint8)


def _strokes(strokes: tuple[Stroke, ...], layers: Layers) -> dict[str, NDArray[Any]]:
    """Lay strokes out one after the other; closed ones end where they begin."""
    starts, parts = [0], [np.zeros((0, 4), np.float32)]
    for stroke in strokes:
        order = np.arange(len(stroke.points) + stroke.closed) % len(stroke.points)
        points = stroke.points[order]
        row, col = layers.grid.to_index(*points.T)
        i = np.clip(row, 0, layers.grid.rows - 1).astype(int)
        j = np.clip(col, 0, layers.grid.cols - 1).astype(int)
        z = layers.depth[i, j]
        parts.append(np.column_stack([points, z, stroke.strength[order]]).astype(np.float32))
        starts.append(starts[-1] + len(points))
    return {
        "stroke_points": np.concatenate(parts),
        "stroke_starts": np.array(starts, np.uint32),
    }


def _layers(view: View) -> dict[str, NDArray[Any]]:
    layers = view.layers
    seen = layers.depth[layers.mask]
    near = (layers.depth - seen.min()) / max(float(np.ptp(seen)), 1e-12)
    return {
        "mask": layers.mask.astype(np.uint8),
        "depth": _bytes(np.where(layers.mask, near, 0.0)),
        "lambert": _bytes(layers.shading.mean(axis=0)),
        "lines": _bytes(1.0 - layers.lines),
        **_strokes(layers.strokes, layers),
    }


def _place(grid: Grid) -> dict[str, Any]:
    return {"pitch_mm": grid.pitch, "origin_mm": list(grid.origin)}


def preview_frame(view: View, solved: Solved | None, job: Job, facts: dict[str, Any]) -> bytes:
    """Show layers, and the relief where it was solved for."""
    arrays = _layers(view)
    if solved:
        arrays["heights"] = solved.relief.heights.astype(np.float32)
    header = {
        **facts,
        **_place(view.layers.grid),
        "matrix": view.part["matrix"],
        "picture": view.facts,
        "worked_out": _worked_out(view, job),
    }
    return pack(header, arrays)


def _worked_out(view: View, job: Job) -> dict[str, str]:
    """Say what settings left empty come to."""
    carving, style = reliefs.carving_of(job), styles.style_of(job)
    form = carving.form_length or 0.02 * max(figure_size(view.layers))
    found = {"form_length": f"{form:.3g}mm", "line_depth": f"{line_depth(carving):.3g}mm"}
    if not style.plain:
        found |= {
            "mark_spacing": f"{style.chisel.spacing:g}mm",
            "mark_depth": f"{style.chisel.depth:g}mm",
            "mark_cutter": style.tool.name,
        }
    if view.kind == MESH:
        found |= {
            "azimuth": f"{view.part['azimuth_deg']:g}deg",
            "elevation": f"{view.part['elevation_deg']:g}deg",
            "up": view.part["up"],
        }
    else:
        found |= {"image": view.kind}
    if "depth_mm" in view.facts:
        found |= {"image_depth": f"{view.facts['depth_mm']:.3g}mm"}
    return found


def panel_frame(panel: Panel, facts: dict[str, Any]) -> bytes:
    """Show a panel."""
    arrays = {
        "positions": panel.vertices.astype(np.float32),
        "indices": panel.faces.astype(np.uint32),
    }
    low, high = panel.vertices.min(axis=0), panel.vertices.max(axis=0)
    extent = [*(high - low)[:2].tolist(), -float(low[2])]
    return pack({**facts, "relief": True, "extent_mm": extent}, arrays)


def carved_frame(trial: Trial, at: float) -> bytes:
    """Show a stock as it is at a moment of a trial."""
    slab, stock = trial.carved(at)
    size = {"size_mm": [stock.width, stock.height], "thickness_mm": stock.thickness}
    return pack({"at": at, **size, **_place(slab.grid)}, {"heights": slab.heights})


def _kinds(run: Run) -> NDArray[np.uint8]:
    return np.where(run.rapid, 0, KINDS.index(run.path.name)).astype(np.uint8)


def _outline(cutter: Cutter) -> list[list[float]]:
    """Half the cutter's silhouette, from the tip upwards, mm."""
    reach = np.linspace(0.0, cutter.radius, 13)
    heights = np.asarray(cutter.profile(reach), float)
    sides = [[cutter.radius, float(max(cutter.flute_length, heights[-1]))]]
    return [[float(r), float(z)] for r, z in zip(reach, heights, strict=True)] + sides


def toolpaths_frame(tried: Tried, facts: dict[str, Any]) -> bytes:
    """Show programs, and what simulation found."""
    verdict = tried.verdict
    moves = [np.column_stack([run.points, run.ends]) for run in tried.runs]
    owner = [np.full(len(run.points), k, np.uint8) for k, run in enumerate(tried.runs)]
    arrays = {
        "moves": np.concatenate(moves).astype(np.float32),
        "kinds": np.concatenate([_kinds(run) for run in tried.runs]),
        "program_of": np.concatenate(owner),
        "deviation": np.where(verdict.figure, verdict.deviation, np.nan).astype(np.float32),
    }
    header = {
        **facts,
        **_place(verdict.grid),
        "kinds": list(KINDS),
        "programs": [_program(run) for run in tried.runs],
        "seconds_total": tried.states.seconds,
        "warnings": [*tried.notes, *verdict.findings],
        "deviation_mm": {
            "gouge": verdict.gouge_mm,
            "excess_p99": verdict.excess_p99_mm,
            "limit": verdict.tolerance_mm,
        },
        "within_tolerance": verdict.within_tolerance,
        "air_cutting": verdict.air_cutting,
    }
    return pack(header, arrays)


def _program(run: Run) -> dict[str, Any]:
    cutter = run.path.cutter
    return {
        "file": run.file,
        "name": run.path.name,
        "cutter": cutter.name,
        "seconds": run.seconds,
        "lines": run.lines,
        "cut_mm": run.path.cutting_length,
        "diameter_mm": cutter.diameter,
        "tip": cutter.shape,
        "profile": _outline(cutter),
        "rpm": run.path.rpm,
        "placing": run.placing,
    }
