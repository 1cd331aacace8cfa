"""Reliefs as files: 32-bit float TIFF that knows its size, 16-bit PNG to look at."""

import io
import json
import zlib
from pathlib import Path

import numpy as np

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.model import Relief

FORMAT = "relieffab relief 1"


def to_tiff(relief: Relief) -> bytes:
    """Pack a relief into a TIFF: heights in mm on page 1, the figure's mask on page 2.

    Pitch, origin and depth stand as JSON in the image description.
    """
    import tifffile

    description = json.dumps(
        {
            "format": FORMAT,
            "pitch_mm": relief.grid.pitch,
            "origin_mm": list(relief.grid.origin),
            "depth_mm": relief.depth,
        }
    )
    file = io.BytesIO()
    with tifffile.TiffWriter(file) as writer:
        writer.write(
            relief.heights.astype(np.float32),
            description=description,
            metadata=None,
            compression="zlib",
            resolution=(10 / relief.grid.pitch, 10 / relief.grid.pitch),
            resolutionunit="CENTIMETER",
        )
        writer.write(relief.mask.astype(np.uint8) * 255, metadata=None, compression="zlib")
    return file.getvalue()


def read_relief(path: str | Path) -> Relief:
    """Read a relief that `to_tiff` packed.

    Raises
    ------
    InputError
        If the file is missing, no TIFF, or not one of ours.
    """
    import tifffile

    where = str(path)
    if not Path(path).is_file():
        raise InputError("there is no such relief", where=where, hint="relieffab relief MODEL")
    try:
        with tifffile.TiffFile(path) as file:
            about = json.loads(file.pages[0].description or "null")
            pages = [page.asarray() for page in file.pages]
    except (tifffile.TiffFileError, ValueError, OSError, zlib.error, IndexError) as fault:
        raise InputError(
            "the relief cannot be read", expected="a TIFF", found=str(fault)[:200], where=where
        ) from fault
    if not isinstance(about, dict) or about.get("format") != FORMAT or len(pages) != 2:
        raise InputError(
            "this TIFF is not a relief of ours",
            expected=f"{FORMAT!r} in its description and two pages",
            found=f"{str(about)[:80]!r} and {len(pages)} pages",
            where=where,
        )
    try:
        pitch, depth = float(about["pitch_mm"]), float(about["depth_mm"])
        x, y = (float(value) for value in about["origin_mm"])
        rows, cols = pages[1].shape
    except (KeyError, TypeError, ValueError) as fault:
        raise InputError(
            "the relief does not say its size",
            expected="pitch_mm, origin_mm and depth_mm, and a mask of one plane",
            found=repr(fault),
            where=where,
        ) from fault
    heights = pages[0].astype(np.float64)
    # Single precision may round the deepest height just past the bound.
    heights = np.where(np.abs(heights + depth) < 1e-6 * depth, -depth, heights)
    return Relief(Grid(rows, cols, pitch, (x, y)), heights, pages[1] > 0, depth)


def grey(relief: Relief) -> np.ndarray:
    """Heights as grey from 0 (-depth) to 1 (the face), (rows + 1, cols + 1)."""
    return 1.0 + relief.heights / relief.depth
