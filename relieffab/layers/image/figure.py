"""Where a picture's figure is: its mask, and what tells it."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.image.picture import Picture

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Figure = tuple[Bools, str]
"""A figure's pixels, and what told them."""

ALPHA, GIVEN, BACKGROUND, SEGMENTED, WHOLE = (
    "alpha", "mask file", "even background", "segmentation", "whole picture",
)  # fmt: skip
LEAST = 1e-3
"""Of the picture: a smaller figure is a speck."""
ALIKE = 0.5
"""Share of the border's pixels that an even background takes."""
SPREAD = 0.25
"""Of the picture's own spread of colours: a border more varied is no background."""
COARSE = 400
"""Pixels at most each way for segmentation."""
ROUNDS = 4
"""Of fitting the background's colours to the border."""
LOSSY = ("JPEG", "WEBP")
"""Formats in which no colour stays exactly what it was."""
SPOT = 0.005
"""Of the figure: smaller spots of the background's colour inside it are shadows, or level in a
normal map."""
STRIP = 5
"""Half the width, pixels of that copy, of what may be background's tone inside a figure."""
GAP, LEAST_GAP = 3, 0.001
"""Half the width of a gap through which background is seen, pixels of that copy, and its area, of
the picture."""
STEEP = 0.7
"""Share of a gap's rim that must step up to the figure: tones that merely pass through the
background's have no edge."""


def opaque(picture: Picture) -> Bools:
    """Pixels that show something: opaque, and numbers; (rows, cols)."""
    seen = np.asarray(np.isfinite(picture.values).all(axis=2), bool)
    return seen if picture.alpha is None else seen & (picture.alpha > 0.5)


def find_figure(picture: Picture, given: Picture | None = None, *, even: bool) -> Figure:
    """Find the figure's pixels, by what tells it most surely.

    In this order: a mask file, transparency and pixels that are no numbers, a
    background of exactly one value that most of the border has, and for
    photographs a segmentation.

    Parameters
    ----------
    picture : Picture
    given : Picture, optional
        A mask: white is the figure.
    even : bool
        Whether an even background is the only one looked for, as for depth and
        normal maps.

    Returns
    -------
    mask : (rows, cols) ndarray of bool
    source : str
        Which of them it was.

    Raises
    ------
    InputError
        If the mask does not fit, or the figure is empty.
    """
    seen = opaque(picture)
    if given is not None:
        mask, source = seen & _given(given, picture.shape), GIVEN
    elif not seen.all():
        mask, source = seen, ALPHA
    else:
        mask, source = _by_colour(picture, even=even)
    mask = _without_specks(mask)
    if not mask.any():
        raise InputError(
            "the figure is empty",
            found=f"no pixel, by {source}",
            where=given.name if given else picture.name,
        )
    return mask, source


def _by_colour(picture: Picture, *, even: bool) -> Figure:
    mask = None if picture.format in LOSSY else _background(picture)
    if mask is not None:
        # In a depth map a spot as far as the background is a hole; normals there face the viewer.
        holes = even and not picture.coloured
        return (mask if holes else _but_shadows(mask)), BACKGROUND
    mask = None if even else _segmented(picture)
    return (opaque(picture), WHOLE) if mask is None else (mask, SEGMENTED)


def _given(mask: Picture, shape: tuple[int, int]) -> Bools:
    if mask.shape != shape:
        raise InputError(
            "the mask does not fit the picture",
            expected=f"{shape[1]} x {shape[0]} pixels",
            found=f"{mask.shape[1]} x {mask.shape[0]}",
            where=mask.name,
        )
    inside: Bools = mask.grey > 0.5 * np.nanmax(mask.grey)
    return inside & opaque(mask)


def border(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pixels along the four sides, one after the other."""
    return np.concatenate([array[0], array[-1], array[1:-1, 0], array[1:-1, -1]])


def _background(picture: Picture) -> Bools | None:
    """All that is not exactly the colour that most of the border has."""
    edge = border(picture.values)
    colours, counts = np.unique(edge, axis=0, return_counts=True)
    if counts.max() < ALIKE * len(edge):
        return None
    colour = colours[counts.argmax()]
    mask: Bools = (picture.values != colour).any(axis=2)
    return mask if LEAST < mask.mean() < 1.0 - LEAST else None


def _but_shadows(mask: Bools) -> Bools:
    """Fill what has the background's colour within the figure, unless it is as large as a hole."""
    parts, _ = ndimage.label(~mask)
    sizes = np.bincount(parts.ravel())
    shadow = sizes < SPOT * mask.sum()
    shadow[np.unique(border(parts))] = False
    return mask | np.asarray(shadow[parts] & ~mask, bool)


def _segmented(picture: Picture) -> Bools | None:
    """Part a photograph's figure from its background by random walks (Grady 2006).

    The border is background; what differs most from its colours, away from it, is
    figure; walks over a small copy decide the rest.
    """
    from skimage.segmentation import random_walker
    from skimage.transform import resize

    shrink = max(1.0, max(picture.shape) / COARSE)
    shape = tuple(max(16, round(n / shrink)) for n in picture.shape)
    small = resize(np.nan_to_num(picture.values), (*shape, picture.values.shape[2]), order=1)
    small = ndimage.gaussian_filter(small, (1.5, 1.5, 0))
    off = np.linalg.norm(small - _even_light(small), axis=2)
    noise = np.percentile(border(off), 90)
    most = np.percentile(off, 98)
    if noise > SPREAD * most:
        return None
    alike, apart = off < 1.2 * noise + 0.02 * most, off > 2.5 * noise + 0.12 * most
    inner = ndimage.binary_erosion(apart, iterations=2)
    if not inner.any():
        return None
    seeds = np.where(inner, 2, _outside(alike) | _gaps(alike, apart)).astype(np.int32)
    label = random_walker(
        small, seeds, beta=300, mode="cg_j", channel_axis=2, tol=1e-4, prob_tol=5e-2
    )
    figure = _but_shadows(label == 2)
    share = figure.mean()
    if not 0.02 < share < 0.95:
        return None
    back = resize(figure.astype(float), picture.shape, order=1) > 0.5
    return np.asarray(back, bool)


def _even_light(picture: Floats) -> Floats:
    """Continue the border's colours inwards: a quadratic each, for light falls off evenly."""
    y, x = (np.linspace(-1.0, 1.0, n) for n in picture.shape[:2])
    x, y = np.meshgrid(x, y)
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
    table, edge = border(terms), border(picture)
    centre = np.median(edge, axis=0)
    alike = np.linalg.norm(edge - centre, axis=1)
    for _ in range(ROUNDS):  # what crosses the border is left out
        used = alike <= max(3.0 * np.median(alike), 1e-6)
        found = np.linalg.lstsq(table[used], edge[used], rcond=None)[0]
        alike = np.linalg.norm(edge - table @ found, axis=1)
    return np.asarray(terms @ found)


def _outside(alike: Bools) -> Bools:
    """Find what is like the border and joined to it, but by no strip."""
    alike = _with_border(alike)
    parts, _ = ndimage.label(_opened(alike, STRIP))
    return _with_border(np.isin(parts, np.setdiff1d(border(parts), 0)))


def _gaps(alike: Bools, apart: Bools) -> Bools:
    """Find where background is seen through the figure: all round, it steps up to that."""
    parts, _ = ndimage.label(_opened(alike, GAP))
    large = np.flatnonzero(np.bincount(parts.ravel()) > LEAST_GAP * parts.size)
    found = np.zeros(alike.shape, bool)
    for k in np.setdiff1d(large, [0, *border(parts)]):
        gap = parts == k
        near = ndimage.binary_dilation(gap, iterations=2 * GAP - 1)
        rim = ndimage.binary_dilation(near) & ~near
        if apart[rim].mean() > STEEP:
            found |= gap
    return found


def _opened(mask: Bools, half: int) -> Bools:
    padded = np.pad(mask, half, mode="edge")
    return np.asarray(ndimage.binary_opening(padded, iterations=half)[half:-half, half:-half], bool)


def _with_border(mask: Bools) -> Bools:
    mask = mask.copy()
    mask[[0, -1]] = mask[:, [0, -1]] = True
    return mask


def _without_specks(mask: Bools) -> Bools:
    """Leave out parts of the figure that are specks beside its largest."""
    parts, count = ndimage.label(mask, np.ones((3, 3)))
    if count < 2:
        return mask
    sizes = np.bincount(parts.ravel())[1:]
    keep = np.concatenate([[False], sizes >= max(LEAST * sizes.max(), 4)])
    return np.asarray(keep[parts], bool)
