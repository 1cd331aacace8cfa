"""Ends of lines: led on to what lies straight ahead, so that no line stops just short."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Floats = NDArray[np.float64]

AHEAD = 6
"""Samples from a line's end that tell where it is heading."""


def _index(lines: Sequence[Floats]) -> tuple[Floats, NDArray[np.int64], cKDTree]:
    """Put the points of lines in one table, with whose each is and a tree to find them by."""
    table = np.concatenate(lines)
    owner = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    return table, owner, cKDTree(table[:, :2])


def lead_on(lines: Sequence[Floats], drawn: Sequence[Floats], reach: float) -> list[Floats]:
    """Lengthen open lines to what lies ahead of their ends.

    Parameters
    ----------
    lines : sequence of (n, k) ndarray
        X and Y first, mm.
    drawn : sequence of (m, k) ndarray
        Other lines that they may meet; they may meet each other too.
    reach : float
        How far ahead to look, within 45 degrees, mm.

    Returns
    -------
    list of (n + 0, 1 or 2, k) ndarray
    """
    if not lines:
        return []
    table, owner, tree = _index([*lines, *drawn])

    def target(line: Floats, own: int) -> int:
        """Row of the table that lies straight ahead of the first point and near; -1 if none."""
        heading = line[0, :2] - line[min(AHEAD, len(line) - 1), :2]
        near = np.array(tree.query_ball_point(line[0, :2], reach), dtype=np.int64)
        near = near[owner[near] != own]
        jump = table[near, :2] - line[0, :2]
        onward = jump @ heading
        aside = np.abs(jump[:, 0] * heading[1] - jump[:, 1] * heading[0])
        ahead = onward > aside
        if not ahead.any():
            return -1
        return int(near[np.where(ahead, aside + 0.5 * onward, np.inf).argmin()])

    begin = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
    aims = {}
    for k, line in enumerate(lines):
        aims[begin[k]], aims[begin[k + 1] - 1] = target(line, k), target(line[::-1], k)
    out = []
    for k, line in enumerate(lines):
        parts = [line]
        for end in (begin[k], begin[k + 1] - 1):
            aim = aims[end]
            # Of two ends that face each other, the first one bridges the gap.
            if aim >= 0 and not (aims.get(aim) == end and aim < end):
                bridge = table[end].copy()
                bridge[:2] = table[aim, :2]
                parts.insert(0 if end == begin[k] else len(parts), bridge[None])
        out.append(np.concatenate(parts))
    return out


def meets(lines: Sequence[Floats], drawn: Sequence[Floats], reach: float) -> list[bool]:
    """Tell which open lines have an end within `reach` mm of another line."""
    if not lines:
        return []
    _, owner, tree = _index([*lines, *drawn])
    ends = [tree.query_ball_point(line[[0, -1], :2], reach) for line in lines]
    return [any((owner[near] != k).any() for near in both) for k, both in enumerate(ends)]
