"""Strokes read back from the SVG they were written to."""

import numpy as np

from relieffab.errors import InputError
from relieffab.layers.model import Stroke

_SVG = "{http://www.w3.org/2000/svg}"


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
    from lxml import etree

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
