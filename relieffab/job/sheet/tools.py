"""Cutters, programs and positions of a job, as rows of the page's tables."""

from collections.abc import Mapping
from typing import Any

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
        low, high = part["bounds_mm"]
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
    boxes = [part["bounds_mm"] for part in report.get("programs", [])]
    rows = []
    for axis, letter in enumerate("XYZ" if boxes else ""):
        low = min(box[0][axis] for box in boxes)
        high = max(box[1][axis] for box in boxes)
        travel = report["machine"]["travel"][axis]
        rows.append(
            {
                "axis": letter,
                "span": span(low, high),
                "needs": mm(round(high - low, 2)),
                "has": mm(travel),
            }
        )
    return rows
