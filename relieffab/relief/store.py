"""Reliefs as files: 32-bit float TIFF that knows its size, or 16-bit PNG that does, too."""

import io
import zlib
from pathlib import Path

import numpy as np

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.about import describe, understand
from relieffab.relief.model import Relief
from relieffab.relief.png import from_png

PNG = b"\x89PNG\r\n\x1a\n"


def to_tiff(relief: Relief) -> bytes:
    """Pack a relief into a TIFF: heights in mm on page 1, the figure's mask on page 2.

    Pitch, origin and depth stand as JSON in the image description.
    """
    import tifffile

    file = io.BytesIO()
    with tifffile.TiffWriter(file) as writer:
        writer.write(
            relief.heights.astype(np.float32),
            description=describe(relief),
            metadata=None,
            compression="zlib",
            resolution=(10 / relief.grid.pitch, 10 / relief.grid.pitch),
            resolutionunit="CENTIMETER",
        )
        writer.write(relief.mask.astype(np.uint8) * 255, metadata=None, compression="zlib")
    return file.getvalue()


_BROKEN = (ValueError, OSError, IndexError, zlib.error, RuntimeError)
"""What tifffile and its codecs raise of a file that is not sound."""


def from_tiff(path: Path) -> Relief:
    """Read a relief that `to_tiff` packed.

    Raises
    ------
    InputError
        If it is no TIFF, or not one of ours.
    """
    import tifffile

    where = str(path)
    try:
        with tifffile.TiffFile(path) as file:
            text = file.pages[0].description
            pages = [page.asarray() for page in file.pages]
    except _BROKEN as fault:
        raise InputError(
            "the relief cannot be read",
            expected="a TIFF or a PNG",
            found=str(fault)[:200],
            where=where,
        ) from fault
    about = understand(text, where)
    if len(pages) != 2 or any(page.ndim != 2 for page in pages):
        raise InputError(
            "this TIFF is not a relief of ours",
            expected="two pages of one plane, heights and mask",
            found=", ".join(str(page.shape) for page in pages),
            where=where,
        )
    heights = pages[0].astype(np.float64)
    # Single precision may round the deepest height just past the bound.
    deepest = np.abs(heights + about.depth) < 1e-6 * about.depth
    heights = np.where(deepest, -about.depth, heights)
    rows, cols = pages[1].shape
    grid = Grid(rows, cols, about.pitch, about.origin)
    return Relief(grid, heights, pages[1] > 0, about.depth)


def read_relief(path: str | Path) -> Relief:
    """Read a relief, TIFF or PNG by the file's first bytes.

    A TIFF gives every height in single precision, a PNG within depth / 65535 / 2;
    grid, mask and depth are the same from both.

    Raises
    ------
    InputError
        If the file is missing, neither of the two, or not one of ours.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError("there is no such relief", where=str(path), hint="relieffab relief MODEL")
    with path.open("rb") as file:
        start = file.read(len(PNG))
    return from_png(path) if start == PNG else from_tiff(path)
