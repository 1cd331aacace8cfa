"""Reliefs as 16-bit grey PNG that any program shows, and that knows its size.

Grey 65535 is the panel's face, 0 lies `depth` below, so a height is off by half a
step, depth / 65535 / 2, at most.  Beside the pixels stand

    pHYs             nodes a metre, rounded to whole ones, for other programs
    Description      what the greys mean, for people
    relieffab        pitch, origin and depth as JSON, exact
    relieffab mask   the figure's pixels, which greys cannot tell where the figure
                     touches the face: one bit each, rows from the far left corner,
                     packed by eights, deflated, in base 64
"""

import base64
import io
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.about import describe, understand
from relieffab.relief.model import Relief

FACE = 65535
SIZE, MASK = "relieffab", "relieffab mask"


def grey(relief: Relief) -> NDArray[np.float64]:
    """Heights as grey from 0 (-depth) to 1 (the face), (rows + 1, cols + 1)."""
    return 1.0 + relief.heights / relief.depth


def to_png(relief: Relief) -> bytes:
    """Pack a relief into a PNG."""
    from PIL import Image, PngImagePlugin

    words = PngImagePlugin.PngInfo()
    words.add_text(
        "Description",
        f"Heights of a sunken relief: grey {FACE} is the panel's face, grey 0 lies "
        f"{relief.depth:g} mm below it; samples are {relief.grid.pitch:g} mm apart.",
    )
    words.add_text(SIZE, describe(relief, face_grey=FACE, floor_grey=0))
    packed = zlib.compress(np.packbits(relief.mask).tobytes())
    words.add_text(MASK, base64.b64encode(packed).decode())
    image = Image.fromarray(np.rint(grey(relief) * FACE).astype(np.uint16))
    file = io.BytesIO()
    dots = 25.4 / relief.grid.pitch
    image.save(file, format="PNG", compress_level=6, pnginfo=words, dpi=(dots, dots))
    return file.getvalue()


def from_png(path: Path) -> Relief:
    """Read a relief that `to_png` packed.

    Raises
    ------
    InputError
        If it is no whole PNG of 16-bit grey, or lacks what `to_png` wrote beside
        the pixels.
    """
    where = str(path)
    pixels, words = _read(path)
    missing = [repr(key) for key in (SIZE, MASK) if key not in words]
    if missing:
        raise InputError(
            "this PNG is not a relief of ours: its greys have no size in mm",
            expected=f"text chunks {SIZE!r} (pitch, origin, depth) and {MASK!r}",
            found=f"no {' and no '.join(missing)}",
            where=where,
            hint="relief.tiff, or the PNG as relieffab wrote it: programs that save it drop them",
        )
    about = understand(words[SIZE], where)
    rows, cols = pixels.shape[0] - 1, pixels.shape[1] - 1
    grid = Grid(rows, cols, about.pitch, about.origin)
    heights = (pixels / FACE - 1.0) * about.depth
    return Relief(grid, heights, _mask(words[MASK], grid, where), about.depth)


def _read(path: Path) -> tuple[NDArray[np.uint16], dict[str, str]]:
    """Read the pixels of a PNG and its texts."""
    from PIL import Image

    try:
        with Image.open(path, formats=["PNG"]) as image:
            image.load()
            words = {str(key): str(text) for key, text in image.info.items()}
            pixels = np.asarray(image)
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as fault:
        raise InputError(
            "the relief cannot be read",
            expected="a PNG",
            found=str(fault)[:200],
            where=str(path),
        ) from fault
    if pixels.dtype != np.uint16 or pixels.ndim != 2:
        raise InputError(
            "this PNG is not a relief of ours",
            expected="16-bit grey",
            found=f"mode {image.mode}",
            where=str(path),
            hint="relief.tiff, or the PNG as relieffab wrote it",
        )
    return pixels, words


def _mask(text: str, grid: Grid, where: str) -> NDArray[np.bool_]:
    """Unpack the figure's pixels."""
    count = grid.rows * grid.cols
    try:
        # Never more than belongs here, whatever the file claims.
        bits = zlib.decompressobj().decompress(base64.b64decode(text, validate=True), count)
    except (ValueError, zlib.error) as fault:
        raise InputError("the relief's mask is broken", found=str(fault), where=where) from fault
    if len(bits) != -(-count // 8):
        raise InputError(
            "the relief's mask does not fit its pixels",
            expected=f"{count} bits",
            found=f"{8 * len(bits)}",
            where=where,
        )
    flat = np.unpackbits(np.frombuffer(bits, np.uint8), count=count)
    return flat.reshape(grid.shape).astype(bool)
