"""Engraving: the drawing's strokes, and what the finishing cutter could not reach."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Stroke
from relieffab.toolpath.passes import Work
from relieffab.toolpath.trace import Trace, sample

Floats = NDArray[np.float64]


def stroke_lines(strokes: Sequence[Stroke]) -> list[Floats]:
    """Turn strokes that are to be cut into lines without doubled points.

    Returns
    -------
    list of (k, 2) ndarray
        X and Y, mm; closed ones end where they start.
    """
    lines = []
    for stroke in strokes:
        if stroke.light:
            continue
        points = np.asarray(stroke.points, dtype=np.float64)
        if stroke.closed:
            points = np.concatenate([points, points[:1]])
        moved = np.append(True, np.any(np.diff(points, axis=0) != 0, axis=1))
        if moved.sum() > 1:
            lines.append(points[moved])
    return lines


def stroke_trace(strokes: Sequence[Stroke], work: Work) -> Trace:
    """Sample the strokes for a cutter to follow."""
    return sample(stroke_lines(strokes), work.step)
