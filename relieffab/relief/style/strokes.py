"""Lines broken into strokes of the hand: where each begins and ends, and how deep it goes."""

from collections.abc import Sequence
from math import ceil

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.style.chisels import Chisel

Floats = NDArray[np.float64]

EVEN = 0.3  # share by which the lengths of strokes differ from their mean, at most
BLOW = 2.0  # spacings from blow to blow
SHORTEST = 1.8  # spacings: what is left of a line and shorter is no stroke


def parts(length: float, chisel: Chisel, chance: np.random.Generator) -> list[tuple[float, float]]:
    """Part a line into strokes.

    Parameters
    ----------
    length : float
        Of the line, spacings.
    chisel : Chisel
    chance : numpy.random.Generator

    Returns
    -------
    list of tuple of float
        Start and end of each, spacings from the line's start.
    """
    if not np.isfinite(chisel.length):
        return [(0.0, length)]
    found, here = [], 0.0
    # The first stroke is the rest of one that began before: so neighbours do not end alike.
    whole = chisel.length * chance.uniform(0.2, 1.0)
    while length - here >= SHORTEST:
        end = min(here + whole, length)
        if length - end < SHORTEST + chisel.gap:
            end = length
        found.append((here, end))
        here = end + chisel.gap
        whole = chisel.length * chance.uniform(1 - EVEN, 1 + EVEN)
    return [(a, b) for a, b in found if b - a >= SHORTEST]


def rise(share: Floats) -> Floats:
    """Go from 0 to 1 smoothly as the share does."""
    s = np.clip(share, 0.0, 1.0)
    return s * s * (3 - 2 * s)


def depths(along: Floats, chisel: Chisel) -> Floats:
    """Depth of a stroke over its length: it enters, goes blow by blow, and leaves.

    A stroke too short for both ramps shortens them alike.

    Parameters
    ----------
    along : (k,) ndarray
        From the stroke's start to its end, spacings.

    Returns
    -------
    (k,) ndarray
        mm.
    """
    length = along[-1] - along[0]
    ramps = chisel.entry + chisel.leave
    fit = min(1.0, length / ramps) if ramps > 0 else 1.0
    since, until = along - along[0], along[-1] - along
    deep = rise(since / max(chisel.entry * fit, 1e-9)) * rise(until / max(chisel.leave * fit, 1e-9))
    blows = 1 - chisel.chatter * 0.5 * (1 - np.cos(2 * np.pi * (since - chisel.entry * fit) / BLOW))
    return chisel.depth * deep * blows


def strokes(
    lines: Sequence[Floats], chisel: Chisel, pixels: float, chance: np.random.Generator
) -> list[tuple[Floats, Floats]]:
    """Break lines into strokes.

    Parameters
    ----------
    lines : sequence of (k, 2) ndarray
        Rows and columns.
    chisel : Chisel
    pixels : float
        In a spacing.
    chance : numpy.random.Generator

    Returns
    -------
    list of tuple of (k, 2) and (k,) ndarray
        Rows and columns, and depths in mm.
    """
    found = []
    for line in lines:
        steps = np.hypot(*np.diff(line, axis=0).T) / pixels
        at = np.concatenate([[0.0], np.cumsum(steps)])
        for start, end in parts(float(at[-1]), chisel, chance):
            # As close as pixels, or the bends between samples show as facets.
            along = np.linspace(start, end, ceil((end - start) * pixels) + 1)
            places = np.column_stack([np.interp(along, at, line[:, k]) for k in (0, 1)])
            found.append((places, depths(along, chisel)))
    return found
