"""Spacing and depth of marks, measured on the relief itself; and whether their cutter made them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.quality.carve import TOLERANCE
from relieffab.relief.style.carve import left_by
from relieffab.relief.style.model import Marks, Style
from relieffab.relief.style.names import NONE

Floats = NDArray[np.float64]

SHALLOW = 1e-3  # mm: less is no mark
FAINT = 0.5  # of the deepest marks' depth: shallower places are ramps
DEEPEST = 95.0  # percentile of the furrows' middles that stands for the deepest marks
FAR = 1.6  # of the spacing looked for: what is farther is no neighbour
BESIDE = 0.4  # of it: what is nearer is the same furrow
ALIKE = 0.9  # cosine of the angle between neighbours' directions
MOST = 5000  # places looked from


@dataclass(frozen=True)
class Measured:
    """Marks as they are on a relief; NaN where there are none.

    Parameters
    ----------
    spacing : float
        Median distance of a furrow's middle from the next furrow's, square to it, or
        of a peck from the nearest, mm.
    depth : float
        Of the deepest marks: their middles' 95th percentile; pecks' median; mm.
    area : float
        Marked, mm².
    within : float
        Share of it where the cutter, on its strokes, leaves no more than the tolerance.
    left : float
        99th percentile of what it leaves there, mm.
    tolerance : float
        mm.
    """

    spacing: float
    depth: float
    area: float
    within: float
    left: float
    tolerance: float = TOLERANCE


def _across(cut: Floats, sigma: float) -> Floats:
    """Find unit vectors square to the furrows, rows and columns, by the structure tensor."""
    down, across = np.gradient(cut)
    dd, da, aa = (
        ndimage.gaussian_filter(part, sigma) for part in (down**2, down * across, across**2)
    )
    angle = 0.5 * np.arctan2(2 * da, dd - aa)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def middles(cut: Floats, apart: float) -> tuple[Floats, Floats]:
    """Find the deepest places across furrows.

    Parameters
    ----------
    cut : (n, m) ndarray
        Depth of the marks at nodes, mm.
    apart : float
        About their spacing, pixels.

    Returns
    -------
    places : (k, 2) ndarray
        Rows and columns, to a part of a pixel.
    across : (k, 2) ndarray
        Unit vectors square to the furrow there.
    """
    marked = cut[cut > SHALLOW]
    if not marked.size:
        return np.zeros((0, 2)), np.zeros((0, 2))
    places = np.argwhere(cut > FAINT * np.percentile(marked, DEEPEST))
    way = _across(cut, apart / 2)[tuple(places.T)]
    before, here, after = (
        ndimage.map_coordinates(cut, (places + k * way).T, order=1, mode="nearest")
        for k in (-1.0, 0.0, 1.0)
    )
    top = (here >= before) & (here > after)
    shift = 0.5 * (before - after)[top] / (before - 2 * here + after)[top]
    return places[top] + np.clip(shift, -0.5, 0.5)[:, None] * way[top], way[top]


def _furrows(cut: Floats, apart: float) -> tuple[float, float]:
    """Distance from furrow to furrow, pixels, and their depth, mm."""
    places, across = middles(cut, apart)
    if not len(places):
        return float("nan"), float("nan")
    tree, gaps = cKDTree(places), []
    for k in range(0, len(places), max(len(places) // MOST, 1)):
        near = np.array(tree.query_ball_point(places[k], FAR * apart))
        away = places[near] - places[k]
        along = np.abs(away @ np.array([-across[k, 1], across[k, 0]]))
        alike = np.abs(across[near] @ across[k]) > ALIKE
        side = (away @ across[k])[(along < 1.0) & alike]
        for way in (side, -side):
            beyond = way[way > BESIDE * apart]
            gaps += [float(beyond.min())] if beyond.size else []
    deep = ndimage.map_coordinates(cut, places.T, order=1, mode="nearest")
    apart_by = float(np.median(gaps)) if gaps else float("nan")
    return apart_by, float(np.percentile(deep, DEEPEST))


def _pecks(cut: Floats, apart: float) -> tuple[float, float]:
    """Distance from a peck to the nearest, pixels, and their depth, mm."""
    peaks = (cut > SHALLOW) & (cut == ndimage.maximum_filter(cut, 2 * int(apart / 3) + 1))
    labels, count = ndimage.label(peaks, np.ones((3, 3)))
    if count < 2:
        return float("nan"), float(cut[peaks].max()) if count else float("nan")
    each = np.arange(1, count + 1)
    places = np.array(ndimage.center_of_mass(cut, labels, each))
    away, _ = cKDTree(places).query(places, k=2)
    return float(np.median(away[:, 1])), float(np.median(ndimage.maximum(cut, labels, each)))


def measure(relief: Relief, marks: Marks, style: Style) -> dict[str, Measured]:
    """Measure the marks of a relief.

    Parameters
    ----------
    relief : Relief
        With its marks.
    marks : Marks
        That it was given.
    style : Style

    Returns
    -------
    dict of Measured
        Of the 'figure', of the 'ground', or of both, as the style has marks there.
    """
    pitch = relief.grid.pitch
    cut = marks.smooth.heights - relief.heights
    left = left_by(relief, marks) - relief.heights
    figure, found = nodes_of(relief.mask), {}
    for name, where, look, wanted in (
        ("figure", figure, _furrows, style.marks != NONE),
        ("ground", ~figure, _pecks, style.pecked),
    ):
        if not wanted:
            continue
        there = np.where(where, cut, 0.0)
        marked = there > SHALLOW
        spacing, depth = look(there, style.chisel.spacing / pitch)
        stands = left[marked] if marked.any() else np.array([np.nan])
        found[name] = Measured(
            spacing=spacing * pitch,
            depth=depth,
            area=float(marked.sum()) * pitch**2,
            within=float((stands <= TOLERANCE).mean()) if marked.any() else float("nan"),
            left=float(np.percentile(stands, 99)),
        )
    return found
