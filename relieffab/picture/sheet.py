"""A contact sheet: pictures in labelled rows and columns."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from relieffab.errors import InputError

Grey = NDArray[np.float64]

WIDEST = 480  # pixels of one picture
GAP = 8
PAPER, INK = 255, 30


def _small(picture: Grey) -> Image.Image:
    """Return a picture as it is laid on the sheet, no wider or higher than fits."""
    image = Image.fromarray(np.rint(255 * np.clip(picture, 0, 1)).astype(np.uint8))
    image.thumbnail((WIDEST, WIDEST), Image.Resampling.LANCZOS)
    return image


def _check(pictures: Sequence[Sequence[Grey]], rows: Sequence[str], cols: Sequence[str]) -> None:
    shapes = {picture.shape for row in pictures for picture in row}
    counts = [len(row) for row in pictures]
    if not (rows and cols) or counts != [len(cols)] * len(rows) or len(shapes) != 1:
        raise InputError(
            "the pictures do not make a sheet",
            expected=f"{len(rows)} rows of {len(cols)} pictures, all of one size",
            found=f"rows of {counts}, sizes {sorted(shapes)}",
        )


def sheet(
    pictures: Sequence[Sequence[Grey]], rows: Sequence[str], cols: Sequence[str]
) -> NDArray[np.uint8]:
    """Lay pictures out beside each other.

    Parameters
    ----------
    pictures : sequence of rows of (h, w) ndarray
        0 (black) to 1 (white), all of one size; wider or higher than 480 pixels they are made
        smaller.
    rows, cols : sequence of str
        Labels on the left and on top.

    Returns
    -------
    (height, width) ndarray of uint8
    """
    _check(pictures, rows, cols)
    small = [[_small(picture) for picture in row] for row in pictures]
    width, height = small[0][0].size
    letters = ImageFont.load_default(size=max(12, width // 20))
    left = GAP + max(round(letters.getlength(label)) for label in rows) + GAP
    line = round(sum(letters.getbbox("Ag")[1::2]))
    top = GAP + line
    size = left + len(cols) * (width + GAP), top + len(rows) * (height + GAP)
    page = Image.new("L", size, PAPER)
    draw = ImageDraw.Draw(page)
    for j, label in enumerate(cols):
        middle = left + j * (width + GAP) + width / 2
        draw.text((middle, top / 2), label, INK, letters, anchor="mm")
    for i, label in enumerate(rows):
        y = top + i * (height + GAP)
        draw.text((GAP, y + height / 2), label, INK, letters, anchor="lm")
        for j, picture in enumerate(small[i]):
            page.paste(picture, (left + j * (width + GAP), y))
    return np.asarray(page)
