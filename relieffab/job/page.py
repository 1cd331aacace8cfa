"""report.html: the job on one page, for the person at the machine."""

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from relieffab.job.folder import SOLIDS

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem }
img { max-width: 100%; height: auto }
table { border-collapse: collapse; width: 100%; margin: 0 0 1.5rem }
th, td { text-align: left; padding: .3rem .8rem .3rem 0; border-bottom: 1px solid #8884 }
.ok { color: #2a7a2a } .bad { color: #b22 }
@media (prefers-color-scheme: dark) {
  body { background: #1b1b1b; color: #ddd } .ok { color: #7c7 }
}
"""

_ALT = {
    "deviation": "Map of what stands above the relief, or was cut below it",
    "look": "The relief wanted, and as the programs leave it, lit alike",
}


def _table(head: list[str], rows: list[list[str]]) -> str:
    top = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    body = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><tr>{top}</tr>{body}</table>"


def clock(seconds: float) -> str:
    """Write seconds as hours and minutes.

    Examples
    --------
    >>> clock(5025)
    '1 h 24 min'
    >>> clock(42)
    '1 min'
    """
    minutes = max(1, round(seconds / 60))
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min"


def _programs(parts: list[dict[str, Any]]) -> str:
    rows = []
    for part in parts:
        (x0, y0, z0), (x1, y1, z1) = part["bounds_mm"]
        rows.append(
            [
                part["file"],
                part["cutter"]["name"],
                f"{part['lines']:,}",
                clock(part["seconds"]),
                f"X {x0:.2f} to {x1:.2f}, Y {y0:.2f} to {y1:.2f}, Z {z0:.2f} to {z1:.2f}",
            ]
        )
    return _table(["program", "cutter", "lines", "time", "bounds, mm"], rows)


def _placings(report: Mapping[str, Any]) -> str:
    """Say where work zero is, position after position."""
    *_, z = report["slab"]["work_zero"]
    placed = {
        part["placing"]: part["position"] for part in report["programs"] if "position" in part
    }
    if not placed:
        radius = report["slab"].get("radius", 0.0)
        return f"<p>Work zero: {_zero(report['slab']['work_zero'], radius)}.</p>"
    rows = [
        [str(place["number"]), placing, _zero([*place["zero"], z])]
        for placing, place in placed.items()
    ]
    return _table(["position", "how the stock lies", "work zero"], rows)


def _zero(zero: Sequence[float], radius: float = 0.0) -> str:
    x, y, z = zero
    if radius:
        level = "on the face" if z == 0 else "on the axis"
        return (
            f"{x:g} mm along the axis from the figure's top, {y:g} mm round the face from its "
            f"right edge, {level}; the stock is {2 * radius:g} mm thick and turns about X"
        )
    level = "on the stock's face" if z == 0 else "under the stock"
    return f"{x:g} mm right and {y:g} mm up from the stock's near left corner, {level}"


def _verdict(part: Mapping[str, Any]) -> str:
    name, text = ("ok", "carves the relief") if part["ok"] else ("bad", "does not carve the relief")
    facts = (
        f"deepest gouge {part['gouge_mm']:.4f} mm; {part['within_tolerance']:.1%} of the figure "
        f"within {part['tolerance_mm']:g} mm; 99 % of it within {part['excess_p99_mm']:.3f} mm; "
        f"{part['air_cutting']:.1%} of the way at a feed is in air"
    )
    for seam in part.get("seams", []):
        one, other = seam["between"]
        facts += (
            f"; 99 % of the seam of positions {one} and {other} within {seam['error_mm']:.3f} mm"
        )
    found = "".join(f"<li>{escape(finding)}</li>" for finding in part["findings"])
    listed = f"<ul>{found}</ul>" if found else ""
    pictures = "".join(
        f'<p><img src="{escape(file)}" alt="{escape(_ALT[kind])}"></p>'
        for kind, file in part.get("pictures", {}).items()
    )
    return f'<p class="{name}"><b>Simulated: {text}.</b></p><p>{facts}.</p>{listed}{pictures}'


def _solid(part: Mapping[str, Any]) -> str:
    rows = [
        ["triangles", f"{part['triangles']:,}"],
        ["volume", f"{part['volume_mm3'] / 1000:.2f} cm³"],
        ["largest error", f"{part['max_error_mm']:.4f} mm"],
    ]
    if "draft" in part:
        rows.append(["least draft", f"{part['draft']['least_deg']:.2f} degrees"])
    for tile in part.get("tiles", []):
        rows.append([tile["file"], " x ".join(f"{side:.1f}" for side in tile["size_mm"]) + " mm"])
    found = "".join(f'<p class="bad">{escape(text)}</p>' for text in part.get("findings", []))
    return _table(["measure", "value"], rows) + found


def page(report: Mapping[str, Any]) -> str:
    """Lay a report out as HTML."""
    name = report.get("model", {}).get("name", "relief")
    parts = [f"<h1>{escape(str(name))}</h1>"]
    if "picture" in report:
        source = escape(report["picture"]["file"])
        parts.append(f'<p><img src="{source}" alt="The carved panel, lit from the upper left"></p>')
    if "verification" in report:
        parts += ["<h2>Verification</h2>", _verdict(report["verification"])]
    if "programs" in report:
        parts += [
            "<h2>Programs, in order</h2>",
            _placings(report),
            _programs(report["programs"]),
        ]
    for solid in SOLIDS:
        if solid in report:
            parts += [f"<h2>{solid.capitalize()}</h2>", _solid(report[solid])]
    notes = report.get("model", {}).get("notes", []) + report.get("material", {}).get("notes", [])
    if notes:
        parts.append("<h2>Notes</h2><ul>")
        parts += [f"<li>{escape(note)}</li>" for note in notes]
        parts.append("</ul>")
    settings = [[key, str(value)] for key, value in report.get("settings", {}).items()]
    parts += ["<h2>Settings</h2>", _table(["setting", "value"], settings)]
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(str(name))}</title>'
        f'<meta name="viewport" content="width=device-width"><style>{_STYLE}</style>'
        + "\n".join(parts)
        + "</html>\n"
    )
