"""How a depth map is meant: which end of its values is near, and how deep it is in mm."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.image.figure import BACKGROUND, border
from relieffab.layers.image.integrate import steps_between
from relieffab.layers.image.picture import Picture

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

USUAL = 0.5
"""Depth of a figure against the shorter side of its picture, where nobody says: as of a body
as thick as it is wide, of which half is seen."""
TELLING = 0.1
"""Correlation of greys with the way in from the edge from which it tells what is near."""

STRIDE = 8
"""Pixels over which a depth map is compared with normals: its grain counts less than its form."""
GENTLE = 2.0
"""Slopes beyond take no part in that."""
_PASSES = 30


def white_is_far(picture: Picture, mask: Bools, source: str) -> tuple[bool, str]:
    """Tell which end of a depth map is near.

    What is beyond the figure is far: an even background says so outright.  Without
    one, figures are nearer in their middle than at their edge.

    Parameters
    ----------
    picture : Picture
    mask : (rows, cols) ndarray of bool
        Its figure.
    source : str
        What the mask came from.

    Returns
    -------
    far : bool
    by : str
        'background', 'form', or 'custom' where neither tells.
    """
    grey = picture.grey
    if source == BACKGROUND:
        beyond = float(np.median(border(grey)))
        return beyond > float(np.median(grey[mask])), "background"
    inward = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1][mask]
    near = np.corrcoef(np.sqrt(inward), grey[mask])[0, 1] if np.ptp(grey[mask]) > 0 else 0.0
    if abs(near) < TELLING:
        return False, "custom"
    return bool(near < 0), "form"


def to_length(grey: Floats, mask: Bools, scale: float, deep: float | None, name: str) -> Floats:
    """Turn greys, larger nearer, into depth.

    Parameters
    ----------
    grey : (rows, cols) ndarray
    mask : (rows, cols) ndarray of bool
    scale : float
        mm a pixel.
    deep : float or None
        From the farthest to the nearest point, mm; `USUAL` if not given.
    name : str
        Of the picture, for messages.

    Returns
    -------
    (rows, cols) ndarray
        mm, the nearest point at 0; 0 outside the figure.

    Raises
    ------
    InputError
        If the figure is level.
    """
    low, high = float(grey[mask].min()), float(grey[mask].max())
    if high <= low:
        raise InputError(
            "the depth map is level: every pixel of the figure is as near as any other",
            found=f"{int(mask.sum())} pixels of {low:g}",
            where=name,
        )
    if deep is None:
        sides = [np.ptp(np.flatnonzero(mask.any(axis=axis))) + 1 for axis in (0, 1)]
        deep = USUAL * scale * float(min(sides))
    return np.where(mask, (grey - high) / (high - low) * deep, 0.0)


def unit_of(depth: Floats, known: Bools, slopes: Floats, pitch: float) -> tuple[float, float]:
    """Tell how long a depth map's unit is by the slopes of normals, steps left out.

    Parameters
    ----------
    depth : (rows, cols) ndarray
        In any unit, either end near.
    known : (rows, cols) ndarray of bool
        Where it and the slopes count.
    slopes : (2, rows, cols) ndarray
        dD/dx and dD/dy of the normals.
    pitch : float
        mm.

    Returns
    -------
    unit : float
        mm, negative where larger is farther; 0 where nothing tells.
    alike : float
        Share of the normals' rises that the depth map has, too: 1 where all do, 0 by chance.
    """
    across, down = steps_between(slopes, known, pitch)
    rises = (_rises(depth, known, across), _rises(depth.T, known.T, down.T))
    want, found = np.concatenate(rises, axis=1)
    gentle = np.abs(want) < GENTLE * pitch * STRIDE
    want, found = want[gentle], found[gentle]
    if not want.any() or not found.any():
        return 0.0, 0.0
    slope = float(want @ found) / float(want @ want)
    for _ in range(_PASSES):  # what lies far off counts ever less
        off = np.abs(found - slope * want)
        weight = 1.0 / (1.0 + (off / (1.5 * np.median(off) + 1e-12)) ** 2) ** 2
        slope = float((weight * want) @ found) / float((weight * want) @ want)
    if slope == 0:
        return 0.0, 0.0
    left, whole = np.median(np.abs(found / slope - want)), np.median(np.abs(want))
    return 1.0 / slope, max(0.0, 1.0 - float(left / whole))


def _rises(depth: Floats, known: Bools, steps: Floats) -> Floats:
    """Rises of normals and of a depth map over `STRIDE` pixels along the rows, (2, n)."""
    near, far = np.s_[:, :-STRIDE], np.s_[:, STRIDE:]
    count, sums = known.cumsum(axis=1), np.pad(steps, ((0, 0), (1, 0))).cumsum(axis=1)
    through = known[near] & (count[far] - count[near] == STRIDE)
    return np.stack([(field[far] - field[near])[through] for field in (sums, depth)])
