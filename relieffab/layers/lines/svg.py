"""Strokes to SVG, 1:1 in mm, and back."""

from collections.abc import Iterable

import numpy as np
from lxml import etree

from relieffab.errors import InputError
from relieffab.layers.lines.names import DRAWN, MARK, NAMES, PRINCIPAL
from relieffab.layers.model import Stroke

_INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
_SVG = "{http://www.w3.org/2000/svg}"


def strokes_to_svg(
    strokes: Iterable[Stroke], size: tuple[float, float], *, width: float = 0.3
) -> str:
    """Write strokes as SVG, 1:1 in mm, one layer for each kind of line.

    Parameters
    ----------
    strokes : iterable of Stroke
    size : tuple of float
        The panel's X and Y, mm.
    width : float
        Of lines that bound a form, mm; the others are half as wide.

    Returns
    -------
    str
    """
    across, high = size
    root = etree.Element(
        f"{_SVG}svg",
        nsmap={None: _SVG[1:-1], "inkscape": _INKSCAPE[1:-1]},
        width=f"{across:g}mm",
        height=f"{high:g}mm",
        viewBox=f"0 0 {across:g} {high:g}",
    )
    strokes = tuple(strokes)
    for kind in (*NAMES, DRAWN, MARK):
        members = [stroke for stroke in strokes if stroke.kind == kind]
        if not members:
            continue
        ink = "goldenrod" if members[0].light else "black"
        group = etree.SubElement(root, f"{_SVG}g", id=kind, fill="none", stroke=ink)
        group.set("stroke-width", f"{pen_width(kind, width):g}")
        group.set("stroke-linecap", "round")
        group.set("stroke-linejoin", "round")
        group.set(f"{_INKSCAPE}groupmode", "layer")
        group.set(f"{_INKSCAPE}label", kind)
        for stroke in members:
            etree.SubElement(group, f"{_SVG}path", d=_path(stroke, high))
    return etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8").decode()


def pen_width(kind: str, width: float) -> float:
    """Say how wide a kind of line is drawn where those that bound a form are `width` wide."""
    return width if kind in (*PRINCIPAL, DRAWN) else width / 2


def _path(stroke: Stroke, high: float) -> str:
    points = " ".join(f"{x:.3f},{high - y:.3f}" for x, y in stroke.points)
    return f"M {points}" + (" Z" if stroke.closed else "")


def strokes_from_svg(text: str, *, where: str = "SVG") -> tuple[Stroke, ...]:
    """Read the polylines of a drawing that `strokes_to_svg` wrote.

    Kinds come back, strengths do not: every point has strength 1.

    Parameters
    ----------
    text : str
    where : str
        For messages.

    Raises
    ------
    InputError
        If it is no SVG, or has paths with anything but straight moves.
    """
    try:
        root = etree.fromstring(text.encode())
    except etree.XMLSyntaxError as fault:
        raise InputError("the drawing is no SVG", found=str(fault)[:200], where=where) from fault
    try:
        high = float(root.get("viewBox", "").split()[3])
        moved = [element for element in root.iter() if element.get("transform")]
        paths = list(root.iter(f"{_SVG}path"))
        if moved or len(paths) != len(root.findall(f"{_SVG}g/{_SVG}path")):
            raise ValueError("a transform, or paths outside the layers")
        return tuple(
            _stroke(path.get("d", ""), str(group.get("id")), high)
            for group in root.iterfind(f"{_SVG}g")
            for path in group.iterfind(f"{_SVG}path")
        )
    except (IndexError, ValueError) as fault:
        raise InputError(
            "the drawing has paths that are not polylines",
            expected="M x,y x,y ... [Z] as relieffab writes them, and a viewBox in mm",
            found=str(fault),
            where=where,
        ) from fault


def _stroke(d: str, kind: str, high: float) -> Stroke:
    words = d.split()
    closed = words[-1] == "Z"
    if words[0] != "M":
        raise ValueError(d[:40])
    pairs = words[1:-1] if closed else words[1:]
    points = np.array([[float(v) for v in pair.split(",")] for pair in pairs])
    points[:, 1] = high - points[:, 1]
    if not np.isfinite(points).all():
        raise ValueError("coordinates that are not numbers")
    return Stroke(points, kind, np.ones(len(points)), closed)
