"""What to see to before the spindle turns."""

from collections.abc import Iterator, Mapping
from typing import Any

from relieffab.job.sheet import tools
from relieffab.job.sheet.words import mm, sides
from relieffab.stock import Stock


def checklist(report: Mapping[str, Any], stock: Stock) -> list[str]:
    """List what to see to, in order; nothing where there are no programs."""
    return list(_steps(report, stock)) if report.get("programs") else []


def zero(stock: Stock) -> str:
    """Say where work zero is."""
    x, y, z = stock.work_zero
    level = "on the stock's face" if z == 0 else "under the stock, on the table"
    if x == 0 and y == 0:
        return f"the stock's near left corner, {level}"
    return f"{mm(x)} mm right and {mm(y)} mm up from the stock's near left corner, {level}"


def _steps(report: Mapping[str, Any], stock: Stock) -> Iterator[str]:
    first = tools.cutters(report)[0]
    safe = report["machine"]["safe_height"]
    size = sides((stock.width, stock.height, stock.thickness))
    yield f"Stock: {report['material']['title']}, {size}; measured, flat, its face up."
    if stock.frame:
        yield f"Frame: {mm(stock.frame.width)} mm wide, made before (frame.step, stock.step)."
    yield f"Clamped; no clamp within the outline reaches {mm(safe)} mm over the face."
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
        yield "After each change of cutter: Z set again on the same face; X and Y stay."


def _aid(file: str) -> str:
    if "probe" in file:
        return f"{file} run, the plate under the cutter: Z is set."
    return f"{file} run, spindle off: the cutter goes round in the air, nothing in its way."
