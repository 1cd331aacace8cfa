"""A relief's file, lit."""

from pathlib import Path
from typing import Any

import numpy as np

from relieffab.job.show.lit import Lit
from relieffab.job.show.shown import Shown
from relieffab.picture import hillshade
from relieffab.relief.model import Relief
from relieffab.relief.store import read_relief


def facts_of(relief: Relief) -> dict[str, Any]:
    """Say how large a relief is, and how deep."""
    grid = relief.grid
    inside = relief.heights[relief.heights < 0]
    return {
        "size_mm": [round(side * grid.pitch, 4) for side in (grid.cols, grid.rows)],
        "pixels": [grid.cols, grid.rows],
        "pitch_mm": grid.pitch,
        "depth_mm": relief.depth,
        "deepest_mm": round(-float(relief.heights.min()), 4),
        "median_depth_mm": round(-float(np.median(inside)), 4) if len(inside) else 0.0,
        "figure_share": round(float(relief.mask.mean()), 4),
    }


def show_relief(path: Path, lit: Lit) -> Shown:
    """Light the relief in a TIFF or a PNG of ours."""
    relief = read_relief(path)
    return Shown("relief", facts_of(relief), hillshade(relief, lit.light, texture=lit.texture))
