"""The depths written along their contours."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief, pixel_slopes
from relieffab.template.contours import Contour, depth_text
from relieffab.template.marks import PAPER, Mark, Text, polyline

Floats = NDArray[np.float64]

SIZE = 2.0  # mm, height of the letters
SHORTEST = 12.0  # mm; shorter contours have no label
EVERY = 3.0  # mm between places along a contour where a label might stand
AGAIN = 35.0  # mm from one label of a contour to its next
APART = 5.0  # mm from one label to those of other contours
ROOM = 1.2  # mm to the next contour that a label needs
CLEAR = 2.0  # mm from a drawn line


def depth_labels(
    contours: Sequence[Contour],
    relief: Relief,
    strokes: Sequence[Stroke],
    colours: Sequence[str],
) -> list[Mark]:
    """Write depths where there is room for them, on flat places first.

    Beside a wall contours run closer than letters are high: those have their
    colour to tell them by.

    Parameters
    ----------
    contours : sequence of Contour
        Of the relief; the longest are labelled first.
    relief : Relief
    strokes : sequence of Stroke
        Drawn lines that labels keep clear of.
    colours : sequence of str
        Of the levels, from 1 on.
    """
    lines = KDTree(_along(strokes))
    labels: list[Mark] = []
    others = np.empty((0, 2))
    for contour in sorted(contours, key=lambda one: -one.length):
        if contour.length < SHORTEST:
            break
        at, turn = _places(contour)
        slope = _slopes(relief, at)
        free = (slope <= contour.depth / contour.level / ROOM) & (lines.query(at)[0] >= CLEAR)
        own: list[int] = []
        for k in np.argsort(slope, kind="stable"):
            if free[k] and _far(at[k], others, APART) and _far(at[k], at[own], AGAIN):
                own.append(int(k))
        colour = colours[contour.level - 1]
        words = depth_text(contour.depth)
        for k in own:
            labels += _label(at[k], float(turn[k]), words, colour)
        others = np.vstack([others, at[own]])
    return labels


def _far(point: Floats, others: Floats, distance: float) -> bool:
    return bool((np.hypot(*(others - point).T) >= distance).all())


def _along(strokes: Sequence[Stroke]) -> Floats:
    """Sample strokes so densely that none slips between two labels."""
    found = [np.empty((0, 2))]
    for stroke in strokes:
        closing = stroke.points[:1] if stroke.closed else stroke.points[:0]
        points = np.vstack([stroke.points, closing])
        gaps = np.hypot(*np.diff(points, axis=0).T)
        arc = np.concatenate([[0.0], np.cumsum(gaps)])
        at = np.linspace(0, arc[-1], int(arc[-1]) + 2)
        found.append(np.stack([np.interp(at, arc, axis) for axis in points.T], axis=1))
    return np.vstack(found)


def _slopes(relief: Relief, at: Floats) -> Floats:
    """Steepness of the relief at points of the panel; infinite beyond its grid."""
    slope = np.hypot(*pixel_slopes(relief.heights, relief.grid.pitch))
    row, col = (np.floor(k).astype(int) for k in relief.grid.to_index(at[:, 0], at[:, 1]))
    rows, cols = relief.grid.shape
    inside = (row >= 0) & (row < rows) & (col >= 0) & (col < cols)
    there = slope[np.clip(row, 0, rows - 1), np.clip(col, 0, cols - 1)]
    return np.where(inside, there, np.inf)


def _places(contour: Contour) -> tuple[Floats, Floats]:
    """Choose where labels might stand: points along the contour, and its angle there."""
    ring = np.vstack([contour.points, contour.points[:1]])
    gaps = np.hypot(*np.diff(ring, axis=0).T)
    arc = np.concatenate([[0.0], np.cumsum(gaps)])
    count = max(4, round(contour.length / EVERY))
    middles = (np.arange(count) + 0.5) / count * contour.length
    before, at, after = (
        np.stack([np.interp((middles + shift) % contour.length, arc, axis) for axis in ring.T], 1)
        for shift in (-SIZE, 0.0, SIZE)
    )
    way = after - before
    return at, np.degrees(np.arctan2(way[:, 1], way[:, 0]))


def _label(middle: Floats, turn: float, words: str, colour: str) -> list[Mark]:
    """Set a label across its contour, never upside down, in a gap of the line."""
    turn = (turn + 90) % 180 - 90
    along = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
    half = (len(words) - 0.5) * 0.278 * SIZE - 0.25 * SIZE  # Helvetica's digits and point
    gap = polyline([middle - half * along, middle + half * along], PAPER, 0.9 * SIZE)
    down = 0.36 * SIZE  # from the middle of a digit to its foot
    x, y = middle + down * np.array([along[1], -along[0]])
    return [gap, Text(float(x), float(y), words, SIZE, colour, turn, "middle")]
