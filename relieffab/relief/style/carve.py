"""What the cutter of the marks leaves of them when it follows its own strokes."""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.relief.model import Relief
from relieffab.relief.style.model import Marks
from relieffab.relief.style.texture import refined, tip_table
from relieffab.relief.sweep import sweep

Floats = NDArray[np.float64]

STEP = 1.0  # pixels from place to place along a stroke


@kernel
def _stand(heights, row, col, table, reach, pitch, out):  # type: ignore[no-untyped-def]
    """Lowest places of a tip over nodes: max over s of h(s) - c(|s - x|)."""
    n, m = heights.shape
    wide = reach / pitch
    for k in range(len(row)):
        highest = -np.inf
        for i in range(max(int(row[k] - wide), 0), min(int(row[k] + wide) + 2, n)):
            for j in range(max(int(col[k] - wide), 0), min(int(col[k] + wide) + 2, m)):
                away = np.sqrt((i - row[k]) ** 2 + (j - col[k]) ** 2) / wide * (len(table) - 1)
                if away < len(table) - 1:
                    a = int(away)
                    height = table[a] + (away - a) * (table[a + 1] - table[a])
                    highest = max(highest, heights[i, j] - height)
        out[k] = highest


def left_by(relief: Relief, marks: Marks) -> Floats:
    """Carve the smooth relief along the marks' lines, nowhere below the one with marks.

    Parameters
    ----------
    relief : Relief
        With its marks.
    marks : Marks

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        What is left at the nodes, mm.
    """
    grid = relief.grid
    deepest = float((marks.smooth.heights - relief.heights).max())
    table, reach = tip_table(marks.cutter, deepest)
    whole = marks.cutter.profile(np.linspace(0.0, marks.cutter.radius, len(table)))
    left = marks.smooth.heights.copy()
    # Between nodes that are few a tip would sink.
    fine, per = refined(relief.heights, reach, grid.pitch)
    for line in marks.lines:
        lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        at = np.linspace(0.0, lengths[-1], max(int(lengths[-1] / (STEP * grid.pitch)), 1) + 1)
        x, y = (np.interp(at, lengths, line[:, k]) for k in (0, 1))
        row, col = grid.to_index(x, y)
        z = np.empty(len(at))
        _stand(fine, per * row, per * col, whole, marks.cutter.radius, grid.pitch / per, z)
        sweep(row, col, -z, table, reach, grid.pitch, left)
    return np.maximum(left, relief.heights)
