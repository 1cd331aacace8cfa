"""What carving leaves beside what was wanted, as a map in colour."""

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from relieffab.errors import InputError

Singles = NDArray[np.float32]

LOW, EVEN, HIGH = (32, 64, 200), (246, 244, 238), (200, 60, 10)
"""Too much gone, as wanted, left standing: red, green, blue."""
OUTSIDE = 0.82  # of the brightness, off the figure
BAR, SHARE = 40, 1 / 24  # height of the legend: at least so many pixels, and of its width
WIDTH = 1200


def deviation_map(
    deviation: Singles, figure: NDArray[np.bool_], limit: float, *, width: int = WIDTH
) -> NDArray[np.uint8]:
    """Colour a deviation: blue where too much is gone, red where something stands.

    Each pixel shows the furthest of the nodes it stands for, so that no fault is
    lost in making the picture small.

    Parameters
    ----------
    deviation : (rows, cols) ndarray
        mm.
    figure : (rows, cols) ndarray of bool
        What is off it is darkened.
    limit : float
        Where the colours are full, mm.
    width : int
        Most pixels across.

    Returns
    -------
    (height, width, 3) ndarray of uint8
        With a legend below.
    """
    if deviation.shape != figure.shape or limit <= 0:
        raise InputError(
            "the deviation and its figure do not fit",
            expected="one shape, and a limit of more than 0 mm",
            found=f"{deviation.shape}, {figure.shape}, {limit:g} mm",
        )
    step = -(-deviation.shape[1] // width)
    share = np.clip(_furthest(deviation, step) / limit, -1, 1)[..., None]
    even, low, high = (np.asarray(colour, float) for colour in (EVEN, LOW, HIGH))
    colour = even + np.where(share < 0, -share * (low - even), share * (high - even))
    inside = _furthest(figure.astype(np.float32), step)[..., None] > 0
    image = np.rint(np.where(inside, colour, OUTSIDE * colour)).astype(np.uint8)
    return np.concatenate([image, _legend(image.shape[1], limit)])


def _furthest(field: Singles, step: int) -> Singles:
    """Take the value furthest from 0 of each block; the last ones may be smaller."""
    rows, cols = (-(-size // step) * step for size in field.shape)
    wide = np.zeros((rows, cols), np.float32)
    wide[: field.shape[0], : field.shape[1]] = field
    blocks = wide.reshape(rows // step, step, cols // step, step)
    low, high = blocks.min(axis=(1, 3)), blocks.max(axis=(1, 3))
    return np.where(-low > high, low, high)


def _legend(width: int, limit: float) -> NDArray[np.uint8]:
    height = max(BAR, round(SHARE * width))
    page = Image.new("RGB", (width, height), "white")
    draw = ImageDraw.Draw(page)
    letters = ImageFont.load_default(size=max(13, round(0.42 * height)))
    left, right = width // 10, width - width // 10
    for x in range(left, right):
        share = 2 * (x - left) / (right - 1 - left) - 1
        end = np.asarray(LOW if share < 0 else HIGH)
        colour = np.rint(np.asarray(EVEN) + abs(share) * (end - EVEN)).astype(int)
        draw.line([(x, 0.1 * height), (x, 0.4 * height)], fill=tuple(colour.tolist()))
    words = f"{limit:g} mm too low", "as wanted", f"{limit:g} mm too high"
    for x, text in zip((left, width // 2, right), words, strict=True):
        draw.text((x, 0.72 * height), text, "black", letters, anchor="mm")
    return np.asarray(page)
