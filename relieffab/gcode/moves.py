"""Moves in a program's own steps, and their lines."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.gcode import arcfit
from relieffab.gcode.post import Post
from relieffab.machine import Machine
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_WORD = {0: "G1", 1: "G3", -1: "G2"}


@dataclass(frozen=True, eq=False)
class Moves:
    """What is to be written of a toolpath.

    Parameters
    ----------
    steps : (n, 3) ndarray of int
        Positions in steps of a written coordinate, from work zero.
    feed : (n,) ndarray
        mm/min; infinite for a rapid.
    turn : (n,) ndarray of int
        0 for a straight move to the point, 1 for an arc counter-clockwise, -1 clockwise.
    centre : (n, 2) ndarray of int
        Of such an arc, steps.
    """

    steps: Ints
    feed: Floats
    turn: Ints
    centre: Ints


def stepped(points: Floats, stock: Stock, post: Post) -> Ints:
    """Round points on the panel to steps from work zero: X and Y, or A, to the nearest, Z up."""
    scaled = stock.to_work(points) * post.scales
    steps: Ints = np.rint(scaled).astype(np.int64)
    steps[:, 2] = np.ceil(scaled[:, 2] - 1e-6).astype(np.int64)
    return steps


def moves_of(toolpath: Toolpath, machine: Machine, stock: Stock, post: Post) -> Moves:
    """Round a toolpath to steps, with the way in and out at the safe height.

    X and Y go to the nearest step, Z to the next one up, so that rounding never
    cuts deeper.  Moves shorter than a step are left out, and level runs of chords
    that lie on a circle become arcs.
    """
    steps = stepped(toolpath.points, stock, post)
    safe = int(np.ceil((machine.safe_height - stock.work_zero[2]) * post.per_mm - 1e-6))
    ends = steps[[0, -1]]
    ends[:, 2] = np.maximum(ends[:, 2], safe)
    steps = np.concatenate([ends[:1], steps, ends[1:]])
    feed = np.concatenate([[np.inf], toolpath.feed, [np.inf]])
    moved = np.concatenate([[True], (np.diff(steps, axis=0) != 0).any(axis=1)])
    if post.turns:
        none = np.zeros(int(moved.sum()), np.int64)
        return Moves(steps[moved], feed[moved], none, np.stack([none, none], axis=1))
    return _with_arcs(steps[moved], feed[moved], arcfit.TOLERANCE * post.per_mm)


def _with_arcs(steps: Ints, feed: Floats, tolerance: float) -> Moves:
    turn, centre = np.zeros(len(steps), np.int64), np.zeros((len(steps), 2))
    arcfit.fit(steps.astype(float), feed, tolerance, turn, centre)
    kept = turn != 2
    return Moves(steps[kept], feed[kept], turn[kept], centre[kept].astype(np.int64))


def lines(moves: Moves, post: Post, machine: Machine) -> Iterator[str]:
    """Write every move but the first; each word only where it changes, if it may be left out."""
    number, modal = post.number, post.dialect.modal
    lengths = iter(_lengths(moves, post))
    gap = "" if modal else " "
    x, y, z = moves.steps[0].tolist()
    mode, rate = "G0" if modal else "", np.inf
    table = zip(
        moves.steps[1:].tolist(),
        moves.feed[1:].tolist(),
        moves.turn[1:].tolist(),
        moves.centre[1:].tolist(),
        strict=True,
    )
    for (to_x, to_y, to_z), to_rate, turn, centre in table:
        words = []
        to_mode = "G0" if to_rate == np.inf else _WORD[turn]
        if to_mode != mode:
            words.append(to_mode)
            mode = to_mode if modal else ""
        if to_x != x or turn:
            words.append("X" + number(to_x))
        if to_y != y or turn:
            words.append(post.across(to_y))
        if to_z != z:
            words.append("Z" + number(to_z))
        if turn:
            words += ["I" + number(centre[0] - x), "J" + number(centre[1] - y)]
        if to_mode == "G0" and post.dialect.rapid_feed:
            to_rate = _rapid(machine, (to_x != x or to_y != y, to_z != z))  # noqa: PLW2901
        length = next(lengths)
        if post.turns and to_mode != "G0":
            words.append("F" + post.inverse(to_rate, length))
        elif to_rate not in (rate, np.inf):
            words.append("F" + post.feed(to_rate))
            rate = to_rate
        x, y, z = to_x, to_y, to_z
        yield gap.join(words)


def _lengths(moves: Moves, post: Post) -> list[float]:
    """Length of each move but the first, on a face that is laid out flat, mm."""
    steps = np.diff(moves.steps, axis=0) / post.scales
    lengths: list[float] = np.linalg.norm(steps, axis=1).tolist()
    return lengths


def _rapid(machine: Machine, moved: tuple[bool, bool]) -> float:
    """Feed of a rapid, for a controller that has to be told: what its slowest axis can."""
    sideways, upright = moved
    rates = machine.max_rate[:2] * sideways + machine.max_rate[2:] * upright
    return min(rates)
