"""Tidying: which parts of sampled lines are worth a stroke, and how they meet."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.ends import lead_on, meets
from relieffab.layers.lines.kinds import Kind
from relieffab.layers.lines.trace import (
    close_gaps,
    drop_short,
    hysteresis,
    length,
    narrowed,
    runs,
    seam,
    soften,
)

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LOW, HIGH = 0.25, 0.5
"""Strength at which a secondary line may go on, and what any line must reach somewhere."""
ALLOWED = 0.9
"""What softening may take off a line that is just long enough."""
WELL_APART = 1.5
"""What a line must be off the stronger ones somewhere, in units of the spacing."""
SOFTNESS = 0.75
"""Deviation of the Gaussian along lines that cross triangles, in units of the spacing."""
STAIRS = 2.0
"""Its least, samples: what takes the stairs of pixels off."""


@dataclass(frozen=True, eq=False)
class Line:
    """A line as it will be drawn, before it is simplified.

    Parameters
    ----------
    kind : str
    table : (n, 3) ndarray
        X and Y, mm, and strength.
    closed : bool
    """

    kind: str
    table: Floats
    closed: bool


@dataclass(frozen=True)
class Rules:
    """What decides which parts of a kind of line become strokes.

    Parameters
    ----------
    step : float
        Between samples, mm.
    low : float
        Strength at which a line may go on.
    min_length, lone_length : float
        Shorter lines are left out, mm, and shorter ones that meet no other.
    hidden, faint : float
        Gaps that are closed where a line is hidden, or too weak, mm.
    spacing : float
        From stronger lines, mm.
    apart : float
        From longer lines of the same kind, mm.
    softness : float
        Deviation of the Gaussian along the line, mm.
    """

    step: float
    low: float
    min_length: float
    lone_length: float
    hidden: float
    faint: float
    spacing: float
    apart: float
    softness: float

    @classmethod
    def of(cls, kind: Kind, drawing: Drawing, step: float) -> "Rules":
        """Choose the rules of a kind.

        A mesh's own edges come in pieces that meet at corners and may lie close, so
        shorter and closer ones count; contours, which bound a form, somewhat.
        """
        spacing = drawing.spacing
        share = 1 / 3 if kind.of_surface is None else 1 / 2 if kind.principal else 1.0
        return cls(
            step=step,
            low=HIGH if kind.principal else LOW,
            min_length=share * drawing.min_length,
            lone_length=drawing.min_length,
            hidden=max(4 * step, 0.2 * drawing.min_length),
            faint=0.5 * drawing.min_length,
            spacing=spacing / 3 if kind.of_surface is None else spacing,
            apart=share * spacing,
            softness=0.0 if kind.of_surface is None else max(SOFTNESS * spacing, STAIRS * step),
        )


def tidy(kind: str, chains: Chains, keep: Flags, drawn: Sequence[Line], rules: Rules) -> list[Line]:
    """Cut the lines worth drawing out of sampled chains, clear of those drawn before.

    Parameters
    ----------
    kind : str
    chains : Chains
        Sampled every `rules.step`.
    keep : (n,) ndarray of bool
        What may be drawn at all.
    drawn : sequence of Line
        Stronger ones.
    rules : Rules

    Returns
    -------
    list of Line
        The longest first.
    """
    room = _room(chains.points[:, :2], drawn, rules.spacing)
    lines = []
    for start, stop in pairwise(chains.begin):
        if keep[start:stop].sum() * rules.step < rules.min_length / 2:
            continue
        here = slice(start, stop)
        table = np.column_stack([chains.points[here, :2], chains.strength[here]])
        lines += _cut(kind, table, keep[here], room[here], rules)
    # Snapped contours may have drawn together.
    lines = [line for line in lines if length(line.table) >= ALLOWED * rules.min_length]
    lines.sort(key=lambda line: -len(line.table))
    return _meet(_thin_out(lines, rules), drawn, rules)


def _room(points: Floats, drawn: Sequence[Line], spacing: float) -> Floats:
    """Distance of points from the lines drawn before, in units of the spacing, 2 at most."""
    if not drawn or len(points) == 0 or spacing == 0:
        return np.full(len(points), 2.0)
    tree = cKDTree(np.concatenate([line.table[:, :2] for line in drawn]))
    return np.minimum(tree.query(points, distance_upper_bound=2 * spacing)[0] / spacing, 2.0)


def _cut(kind: str, table: Floats, keep: Flags, room: Floats, rules: Rules) -> list[Line]:
    """Cut the lines worth drawing out of one."""
    closed = len(table) > 2 and bool((table[0, :2] == table[-1, :2]).all())
    if closed:
        table, keep, room = table[:-1], keep[:-1], room[:-1]
    table = soften(table, rules.softness / rules.step, closed=closed).copy()
    if closed:
        first = seam(keep & (table[:, 2] > rules.low) & (room >= 1))
        table, keep, room = np.roll(table, -first, 0), np.roll(keep, -first), np.roll(room, -first)
    hidden = rules.hidden / rules.step
    strong = close_gaps(table[:, 2] > rules.low, rules.faint / rules.step, closed=closed)
    keep = hysteresis(close_gaps(keep, hidden, closed=closed) & strong, table[:, 2], HIGH)
    keep = _apart(close_gaps(keep, hidden, closed=closed), room, rules.spacing, rules)
    table[:, 2] = np.maximum(table[:, 2], rules.low)
    return _pieces(kind, table, keep, closed=closed)


def _pieces(kind: str, table: Floats, keep: Flags, *, closed: bool) -> list[Line]:
    if closed and keep.all():
        return [Line(kind, table, True)]
    return [Line(kind, table[a:b], False) for a, b in zip(*runs(keep), strict=True)]


def _apart(keep: Flags, room: Floats, spacing: float, rules: Rules) -> Flags:
    """Keep what is long enough on its own, and lead it a little way to what it nears."""
    near, little = room < 1, int(spacing / rules.step)
    alone = drop_short(keep & close_gaps(~near, 2 * little), rules.min_length / rules.step)
    alone = hysteresis(alone, room, WELL_APART)
    return hysteresis(keep & ~narrowed(near, little), alone.astype(np.float64), 1.0)


def _thin_out(lines: list[Line], rules: Rules) -> list[Line]:
    """Leave out what runs beside a longer line of the same kind."""
    if not lines or rules.apart == 0:
        return lines
    owner = np.repeat(np.arange(len(lines)), [len(line.table) for line in lines])
    points = np.concatenate([line.table[:, :2] for line in lines])
    pairs = cKDTree(points).query_pairs(2 * rules.apart, output_type="ndarray")
    a, b = pairs[owner[pairs[:, 0]] != owner[pairs[:, 1]]].T
    room = np.full(len(points), 2.0)
    distance = np.hypot(*(points[a] - points[b]).T) / rules.apart
    np.minimum.at(room, np.where(owner[a] > owner[b], a, b), distance)
    out = []
    for k, line in enumerate(lines):
        table, clear = line.table, room[owner == k]
        if line.closed:
            first = seam(clear >= 1)
            table, clear = np.roll(table, -first, axis=0), np.roll(clear, -first)
        keep = _apart(np.ones(len(table), bool), clear, rules.apart, rules)
        out += _pieces(line.kind, table, keep, closed=line.closed)
    return out


def _meet(lines: list[Line], drawn: Sequence[Line], rules: Rules) -> list[Line]:
    """Lead open lines on to what they all but reach; leave out short ones that reach nothing."""
    tables = [line.table for line in lines if not line.closed]
    others = [line.table for line in [*drawn, *(line for line in lines if line.closed)]]
    reach = 2 * rules.spacing
    met = iter(lead_on(tables, others, reach))
    meeting = iter(meets(tables, others, reach))
    out = []
    for line in lines:
        if line.closed:
            out.append(line)
            continue
        table, reaches = next(met), next(meeting)
        if reaches or length(line.table) >= ALLOWED * rules.lone_length:
            out.append(replace(line, table=table))
    return out
