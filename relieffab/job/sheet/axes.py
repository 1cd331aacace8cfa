"""The second axis of a job: Y, or what turns a round stock."""

from collections.abc import Mapping
from math import degrees
from typing import Any, NamedTuple

from relieffab.gcode.dialect import dialect
from relieffab.gcode.post import Post


class Second(NamedTuple):
    """How programs go along Y, or round a stock.

    Parameters
    ----------
    letter : {'Y', 'A'}
    unit : {'mm', '°'}
    per_mm : float
        Of the unit to a mm, as report.json has it.
    turns : bool
        Whether it turns the stock: there is no end to its travel.
    """

    letter: str
    unit: str
    per_mm: float
    turns: bool


def second_of(report: Mapping[str, Any]) -> Second:
    """Tell the second axis of the programs of a report.

    Parameters
    ----------
    report : mapping
        What report.json holds.
    """
    radius = report["slab"].get("radius", 0.0) if "slab" in report else 0.0
    if not radius:
        return Second("Y", "mm", 1.0, turns=False)
    post = Post(dialect(report["machine"]["dialect"]), radius=radius)
    if post.turns:
        return Second("A", "°", -degrees(1) / radius, turns=True)
    return Second("Y", "mm", 1.0, turns=True)
