"""Strokes as ink: an image with smooth edges, and its dilation and erosion."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.grid import Grid
from relieffab.layers.model import Stroke

Floats = NDArray[np.float64]


@kernel
def _ink(segments, strengths, half, image):  # type: ignore[no-untyped-def]
    """Lay segments (row, col, row, col) of half-width `half` pixels on the image.

    Ink is the share of a pixel's width that the stroke covers, along the shortest
    way from its centre; where strokes cross, the darker one counts.
    """
    rows, cols = image.shape
    full = min(1.0, 2.0 * half)
    for k in range(len(segments)):
        r0, c0, r1, c1 = segments[k]
        dr, dc = r1 - r0, c1 - c0
        length2 = dr * dr + dc * dc
        reach = half + 0.5
        for i in range(
            max(0, int(np.ceil(min(r0, r1) - reach))),
            min(rows - 1, int(np.floor(max(r0, r1) + reach))) + 1,
        ):
            for j in range(
                max(0, int(np.ceil(min(c0, c1) - reach))),
                min(cols - 1, int(np.floor(max(c0, c1) + reach))) + 1,
            ):
                t = 0.0
                if length2 > 0.0:
                    t = min(1.0, max(0.0, ((i - r0) * dr + (j - c0) * dc) / length2))
                off = np.hypot(i - r0 - t * dr, j - c0 - t * dc)
                cover = min(full, max(0.0, reach - off))
                ink = cover * (strengths[k, 0] + t * (strengths[k, 1] - strengths[k, 0]))
                image[i, j] = max(image[i, j], ink)


def line_image(strokes: Iterable[Stroke], grid: Grid, *, width: float) -> Floats:
    """Draw strokes with smooth edges.

    Parameters
    ----------
    strokes : iterable of Stroke
    grid : Grid
    width : float
        Of a stroke, mm.

    Returns
    -------
    (rows, cols) ndarray
        Ink, 0 to 1: a stroke's strength where it covers the pixel.
    """
    segments, strengths = [np.empty((0, 4))], [np.empty((0, 2))]
    for stroke in strokes:
        row, col = grid.to_index(stroke.points[:, 0], stroke.points[:, 1])
        table = np.stack([row - 0.5, col - 0.5, stroke.strength], axis=1)
        ahead = np.roll(table, -1, axis=0)
        count = len(table) if stroke.closed else len(table) - 1
        segments.append(np.hstack([table[:count, :2], ahead[:count, :2]]))
        strengths.append(np.stack([table[:count, 2], ahead[:count, 2]], axis=1))
    image = np.zeros(grid.shape)
    _ink(np.concatenate(segments), np.concatenate(strengths), width / grid.pitch / 2, image)
    return image


def spread_ink(image: Floats, by: float, grid: Grid) -> Floats:
    """Dilate or erode ink by a disc (Wang 2011, Fig. 4).

    Parameters
    ----------
    image : (rows, cols) ndarray
        Ink, 0 to 1.
    by : float
        Radius of the disc, mm; above 0 lines grow bolder, below 0 finer.
    grid : Grid

    Returns
    -------
    (rows, cols) ndarray
    """
    radius = abs(by) / grid.pitch
    if radius < 1:
        return image
    from skimage.morphology import dilation, erosion

    reach = np.arange(-int(radius), int(radius) + 1)
    disc = reach[:, None] ** 2 + reach**2 <= radius**2
    return (dilation if by > 0 else erosion)(image, disc)  # type: ignore[no-any-return]
