"""Report to the drawings of its stock, each with a caption."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from relieffab.job.sheet import curved, plan, section, turning
from relieffab.job.sheet.axes import second_of
from relieffab.job.sheet.drawing import Drawing
from relieffab.job.sheet.pictures import Picture
from relieffab.round import Curved, Round
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

Captioned = tuple[str, Drawing]


def drawings(
    report: Mapping[str, Any],
    stock: Stock,
    bent: Round | Curved | None,
    depth: float,
    kept: Picture | None,
) -> list[Captioned]:
    """Draw the stock of a job: as it lies at each position, and cut open.

    Parameters
    ----------
    report : mapping
        What report.json holds.
    stock : Stock
        As it lies on the machine.
    bent : Round, Curved or None
        What it is if it is not flat.
    depth : float
        Of the relief, mm; 0 where there is none.
    kept : Picture or None
        The relief from above.
    """
    if isinstance(bent, Curved):
        near = ("From the near side, to scale", curved.draw(bent, depth))
        return [*_plans(report, stock, None), near] if report.get("programs") else [near]
    plans = _plans(report, stock, kept)
    if bent is None:
        side = section.draw(stock, depth, report.get("machine"))
        return [*plans, ("From the operator's side; widths not to scale", side)]
    return [*plans, *_turning(report, stock, bent, depth)]


def _turning(report: Mapping[str, Any], stock: Stock, bent: Round, depth: float) -> list[Captioned]:
    box = plan.bounds_of(report.get("programs", []), stock)
    cut = (0.0, stock.width) if box is None else (float(box[0][0]), float(box[1][0]))
    safe = report["machine"]["safe_height"] if "machine" in report else 0.0
    letter = second_of(report).letter if box is not None else ""
    return [
        ("From the operator's side, cut open", turning.along(stock, bent, depth, cut, safe)),
        (
            f"Against X, from the figure's foot: {turning.arc_words(bent)}",
            turning.across(stock, bent, depth, letter),
        ),
    ]


def count_positions(report: Mapping[str, Any]) -> int:
    """Count how often the stock is laid on the machine."""
    return len({part.get("placing", "") for part in report.get("programs", [])} or {""})


def _plans(report: Mapping[str, Any], stock: Stock, kept: Picture | None) -> list[Captioned]:
    """Draw the stock once for each position, and say how it lies."""
    parts = report.get("programs", [])
    places = {part["placing"]: part["position"] for part in parts if "position" in part}
    travel = report["machine"]["travel"] if parts else None
    picture, letter = _seen(report, stock, kept), second_of(report).letter
    drawn = []
    for placing, place in (places or {"": None}).items():
        position = Position.of(place) if place else None
        lies = plan.lying(stock, position)
        here = [part for part in parts if part.get("placing", "") == placing]
        shown = plan.Plan(lies, position, plan.bounds_of(here, lies), travel, picture, letter)
        words = "The face laid out flat, as the cutter meets it" if stock.radius else ""
        if position:
            words = f"Position {position.number} of {position.count}: {placing}"
        drawn.append((words, plan.draw(shown)))
    return drawn


def _seen(report: Mapping[str, Any], stock: Stock, kept: Picture | None) -> Any:
    """Find where on the stock the picture of the height field belongs."""
    if kept is None:
        return None
    relief = report["relief"]
    x, y = relief["origin_mm"]
    wide, tall = ((relief[name] - 1) * relief["pitch_mm"] for name in ("cols", "rows"))
    low, high = np.array([x, y - tall]), np.array([x + wide, y])
    if stock.radius:  # as `relieffab.relief.laid` lays it
        corner = np.array([stock.width, stock.height])
        low, high = corner - high[::-1], corner - low[::-1]
    return kept.uri, low, high
