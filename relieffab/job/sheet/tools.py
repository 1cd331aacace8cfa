"""Cutters, programs and positions of a job, as rows of the page's tables."""

from collections.abc import Mapping
from typing import Any

from relieffab.job.sheet.axes import second_of
from relieffab.job.sheet.reach import reach_of
from relieffab.job.sheet.words import clock, mm, span

Row = dict[str, Any]


def cutters(report: Mapping[str, Any]) -> list[Row]:
    """List the cutters in the order they are needed, each once, and how they are driven."""
    rows: dict[str, Row] = {}
    for part in report.get("programs", []):
        cutter, feeds = part["cutter"], part["feeds"]
        reach = reach_of(part, report["slab"])
        row = rows.setdefault(
            cutter["name"],
            {
                "name": cutter["name"],
                "title": cutter["title"] or f"{cutter['shape']}, {mm(cutter['diameter'])} mm",
                "measures": _measures(cutter),
                "least": 0.0,
                "deep": 0.0,
                "known": reach.known,
                "rpm": part["rpm"],
                "feed": feeds["feed"],
                "plunge": feeds["plunge"],
                "stepdown": feeds["stepdown"],
                "verified": feeds["verified"],
                "source": feeds["source"],
                "files": [],
            },
        )
        row["least"], row["deep"] = max(row["least"], reach.least), max(row["deep"], reach.deep)
        row["files"].append(part["file"])
    return list(rows.values())


def _measures(cutter: Mapping[str, Any]) -> list[tuple[str, str]]:
    """List what to measure a cutter by."""
    shank = cutter.get("shank_diameter") or cutter["diameter"]
    found = [("diameter", f"{mm(cutter['diameter'])} mm")]
    if cutter.get("tip_diameter"):
        found.append(("tip", f"{mm(cutter['tip_diameter'])} mm"))
    if cutter.get("corner_radius"):
        found.append(("corner", f"{mm(cutter['corner_radius'])} mm"))
    if cutter.get("angle"):
        found.append(("angle", f"{mm(cutter['angle'])}°"))
    return [*found, ("flutes", f"{mm(cutter['flute_length'])} mm"), ("shank", f"{mm(shank)} mm")]


def programs(report: Mapping[str, Any]) -> list[Row]:
    """List the programs in their order, with time and bounds."""
    rows = []
    for number, part in enumerate(report.get("programs", []), 1):
        low, high = _box(part, report)
        rows.append(
            {
                "number": number,
                "file": part["file"],
                "cutter": part["cutter"]["name"],
                "position": part.get("position", {}).get("number"),
                "time": clock(part["seconds"]),
                "lines": f"{part['lines']:,}",
                "way": f"{part['cut_mm'] / 1000:,.1f} m",
                "bounds": [span(a, b) for a, b in zip(low, high, strict=True)],
            }
        )
    return rows


def total(report: Mapping[str, Any]) -> str:
    """Write the time of all programs."""
    return clock(sum(part["seconds"] for part in report["programs"]))


def reaches(report: Mapping[str, Any]) -> list[Row]:
    """Hold what the programs span against the machine's travel, axis by axis."""
    boxes = [_box(part, report) for part in report.get("programs", [])]
    rows = []
    for axis, (letter, unit) in enumerate(axes(report) if boxes else ()):
        low = min(box[0][axis] for box in boxes)
        high = max(box[1][axis] for box in boxes)
        endless = axis == 1 and second_of(report).turns
        rows.append(
            {
                "axis": letter,
                "span": f"{span(low, high)} {unit}",
                "needs": _with(unit, round(high - low, 2)),
                "has": "no end" if endless else _with(unit, report["machine"]["travel"][axis]),
            }
        )
    return rows


def axes(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Name the axes of the programs and their units."""
    second = second_of(report)
    return [("X", "mm"), (second.letter, second.unit), ("Z", "mm")]


def _with(unit: str, value: float) -> str:
    return f"{mm(value)}°" if unit == "°" else f"{mm(value)} {unit}"


def _box(part: Mapping[str, Any], report: Mapping[str, Any]) -> tuple[list[float], list[float]]:
    """Give what a program spans, each axis in its own unit."""
    per_mm = second_of(report).per_mm
    (x0, y0, z0), (x1, y1, z1) = part["bounds_mm"]
    low, high = sorted((y0 * per_mm, y1 * per_mm))
    return [x0, low, z0], [x1, high, z1]
