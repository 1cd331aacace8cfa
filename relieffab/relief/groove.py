"""Grooves of the drawn lines, as a pen's rounded stroke or as a cutter's own tip leaves them."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.relief.model import to_nodes
from relieffab.relief.reach import Profile
from relieffab.relief.sweep import reach_of, sweep

Floats = NDArray[np.float64]

BEYOND = 0.3  # mm downhill from a line to the middle of its groove
SOFT = 0.12, 0.2  # mm over which the ink, and the depth that says where downhill is, are smoothed
STEEP = 0.3  # slope from which a groove lies wholly downhill of its line
FAINT = 0.5  # of the line depth: a line without strength
SAMPLES = 256  # of a tip's profile


def uphill(layers: Layers) -> Floats:
    """Direction in which the figure comes nearer, rows and columns, (2, rows, cols).

    A unit vector from a slope of `STEEP` on, shorter where it is gentler.  What
    lies outside the figure counts as its farthest point.
    """
    floor = layers.depth[layers.mask].min() if layers.mask.any() else 0.0
    depth = np.where(layers.mask, layers.depth, floor)
    rise = np.stack(
        [
            ndimage.gaussian_filter(depth, SOFT[1] / layers.pitch, order=order) / layers.pitch
            for order in ((1, 0), (0, 1))
        ]
    )
    return rise / np.maximum(np.hypot(*rise), STEEP)  # type: ignore[no-any-return]


def inked(layers: Layers, line_depth: float) -> Floats:
    """Profile of the lines on nodes, 0 beside them, negative in them, mm.

    A groove lies downhill of its line, which is then where its uphill wall stands:
    at an occlusion the nearer part keeps its height up to its contour and the
    farther one is cut, as on incised reliefs of Egypt.  Such a wall leans as the
    surface does, so that lines are seen, yet tell no other shape.  On level
    ground a groove lies under its line.

    Ink is rounded over a third of a millimetre, so that strokes have flanks a
    cutter can follow; full strength reaches the line depth.
    """
    ink = np.minimum(1.25 * ndimage.gaussian_filter(layers.lines, SOFT[0] / layers.pitch), 1.0)
    at = np.indices(ink.shape) + BEYOND / layers.pitch * uphill(layers)
    moved = ndimage.map_coordinates(ink, at, order=1)
    return -line_depth * to_nodes(moved, np.ones_like(ink))


def swept(layers: Layers, line_depth: float, profile: Profile) -> Floats:
    """Profile of the strokes as a cutter that follows them leaves it, on nodes.

    Principal lines are deeper: a stroke of full strength reaches the line depth,
    one without strength half of it.

    Parameters
    ----------
    layers : Layers
        With strokes.
    line_depth : float
        mm.
    profile : callable
        Distance from the cutter's axis to height above its lowest point, mm.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        mm; 0 beside the lines, negative in them.

    Raises
    ------
    InputError
        If there is ink, but no strokes to follow.
    """
    out = np.zeros(layers.grid.node_shape)
    if line_depth == 0:
        return out
    inked_strokes = [stroke for stroke in layers.strokes if not stroke.light]
    if not inked_strokes and layers.lines.any():
        raise InputError(
            "a cutter cannot follow lines that are only a picture",
            expected="layers with strokes",
            hint="make the layers from the model, or carve the lines rounded",
        )
    return _lowered(out, layers.grid, inked_strokes, line_depth, profile)


def _lowered(out, grid: Grid, strokes, line_depth: float, profile: Profile) -> Floats:  # type: ignore[no-untyped-def]
    reach = reach_of(profile, line_depth)
    table = np.minimum(profile(np.linspace(0.0, reach, SAMPLES)), 2 * line_depth)
    for stroke in strokes:
        ends = [stroke.points, stroke.points[:1]] if stroke.closed else [stroke.points]
        points = np.concatenate(ends)
        strength = np.concatenate(
            [stroke.strength, stroke.strength[: len(points) - len(stroke.strength)]]
        )
        deep = line_depth * (FAINT + (1 - FAINT) * strength)
        row, col = grid.to_index(points[:, 0], points[:, 1])
        sweep(row, col, deep, table, reach, grid.pitch, out)
    return out
