"""What to see to before the spindle turns."""

from collections.abc import Iterator, Mapping
from math import pi
from typing import Any

from relieffab.job.sheet import tools
from relieffab.job.sheet.axes import second_of
from relieffab.job.sheet.stocks import measures, zero
from relieffab.job.sheet.words import mm
from relieffab.round import Curved, Round
from relieffab.stock import Stock


def checklist(
    report: Mapping[str, Any], stock: Stock, bent: Round | Curved | None = None
) -> list[str]:
    """List what to see to, in order; nothing where there are no programs."""
    return list(_steps(report, stock, bent)) if report.get("programs") else []


def _steps(report: Mapping[str, Any], stock: Stock, bent: Round | Curved | None) -> Iterator[str]:
    first = tools.cutters(report)[0]
    held = f"Stock: {report['material']['title']}, {measures(stock, bent)}; measured"
    yield from _round(report, stock, held) if stock.radius else _flat(report, stock, held)
    yield f"{first['name']} in the collet, at least {mm(first['least'])} mm out of it; nut tight."
    if any("position" in part for part in report["programs"]):
        yield "Stock as position 1 shows it; its fence or marks for the next ones made."
    yield f"Work zero at {zero(stock)}; found with this cutter."
    for part in report.get("aids", []):
        yield _aid(part["file"])
    yield "Programs as they were proved: relieffab verify, or the sums below."
    if not all(row["verified"] for row in tools.cutters(report)):
        yield "Feeds have no source: tried in foam or offcuts first, started slower."
    yield "Eyes and ears covered, dust drawn off, hand at the stop."
    if len(report["programs"]) > 1:
        kept = f"X and {_second(report)} stay"
        yield f"After each change of cutter: Z set again on the same face; {kept}."


def _second(report: Mapping[str, Any]) -> str:
    return second_of(report).letter


def _flat(report: Mapping[str, Any], stock: Stock, held: str) -> Iterator[str]:
    yield f"{held}, {'on its flat back' if stock.curve else 'flat'}, its face up."
    if stock.frame:
        yield f"Frame: {mm(stock.frame.width)} mm wide, made before (frame.step, stock.step)."
    safe = mm(report["machine"]["safe_height"])
    yield f"Clamped; no clamp within the outline reaches {safe} mm over the face."


def _round(report: Mapping[str, Any], stock: Stock, held: str) -> Iterator[str]:
    """Say how a round stock is held, and how the axis that turns it is set."""
    yield f"{held}, turned true; the figure's top towards X's low end."
    yield "Chucked, its far end in the tailstock if it is long; it runs true, its axis along X."
    boxes = [part["bounds_mm"] for part in report["programs"]]
    low, high = min(box[0][0] for box in boxes), max(box[1][0] for box in boxes)
    safe = mm(report["machine"]["safe_height"])
    yield (
        f"From X {mm(low)} to {mm(high)} mm, all the way round, nothing of chuck or tailstock "
        f"reaches {safe} mm over the face."
    )
    if _second(report) == "A":
        yield "Y: the cutter right over the axis; it stays there. No limits on A."
        yield "A 0: the stock turned until what is to be work zero lies under the cutter."
        return
    around = 2 * pi * stock.radius
    yield "The table's own Y: the cutter right over the axis, and held there."
    yield (
        f"Y drives the rotary axis: $101 is its steps for a whole turn / {around:.3f}, for this "
        f"stock alone; $111 {report['machine']['max_rate'][1]:.0f} mm/min, "
        f"$121 {report['machine']['acceleration'][1]:.0f} mm/s² at most; no limits ($20=0, $21=0)."
    )
    yield "Y 0: the stock turned until what is to be work zero lies under the cutter."


def _aid(file: str) -> str:
    if "probe" in file:
        return f"{file} run, the plate under the cutter: Z is set."
    return f"{file} run, spindle off: the cutter goes round in the air, nothing in its way."
