"""SVG files: their paths, flattened, in the order in which they are painted."""

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.art.art import Art, Mark, Ring
from relieffab.layers.art.curves import FINE, ring

Floats = NDArray[np.float64]

MM = 25.4
"""Pixels to an inch that make a pixel 1 mm."""
PAPER = 0.93
"""Brightness from which a fill is the paper's own."""
LARGEST = 64_000_000
"""Bytes: no drawing is larger."""
_LENGTH = re.compile(r"^\s*[+]?[\d.]+(?:e[+-]?\d+)?\s*(mm|cm|in|pt|pc|q)\s*$", re.IGNORECASE)


def read_svg(path: str | Path) -> Art:
    """Read the paths of an SVG: shapes, transforms, `use`, viewBox, styles.

    Fills as light as paper cover what lies under them; text, pictures and scripts
    are left out, and said so.

    Raises
    ------
    InputError
        If it is no SVG, refers to other files, or has no path to be seen.
    """
    path = Path(path)
    where = str(path)
    if path.stat().st_size > LARGEST:
        raise InputError(
            "the SVG is too large",
            expected=f"at most {LARGEST // 10**6} MB",
            found=f"{path.stat().st_size / 1e6:.0f} MB",
            where=where,
        )
    root = _parsed(path.read_bytes(), where)
    notes = _left_out(root)
    marks = _marks(root, where)
    if not marks:
        why = f" ({'; '.join(notes)})" if notes else ""
        raise InputError(
            f"the SVG has no path to be seen{why}",
            expected="paths or shapes with a fill or a stroke",
            where=where,
            hint="turn text into paths where it was drawn; give a picture as a picture",
        )
    return Art(marks, _page(root), path.name, "svg", notes)


def _parsed(data: bytes, where: str) -> Any:
    """Parse without fetching or expanding anything from outside."""
    from lxml import etree

    if re.search(rb"<!ENTITY[^>]*\b(SYSTEM|PUBLIC)\b", data):
        raise InputError(
            "the SVG refers to other files by external entities, which are not read",
            where=where,
            hint="save it as plain SVG",
        )
    parser = etree.XMLParser(resolve_entities=True, no_network=True, load_dtd=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as fault:
        raise InputError("the SVG cannot be read", found=str(fault)[:200], where=where) from fault
    if etree.QName(root).localname != "svg":
        raise InputError("this is XML, but no SVG", found=f"<{root.tag}>", where=where)
    return root


def _left_out(root: Any) -> tuple[str, ...]:
    """Take out what is not drawn, and say what that was."""
    from lxml import etree

    notes = []
    for name, said in (
        ("script", "scripts left out"),
        ("text", "texts left out: only paths are carved"),
        ("image", "pictures left out: only paths are carved"),
        ("foreignObject", "foreign objects left out"),
    ):
        found = list(root.iter("{*}" + name))
        for element in found:
            if element.getparent() is not None:
                element.getparent().remove(element)
        if found:
            notes.append(f"{len(found)} {said}")
    clipped = sum(1 for e in root.iter(etree.Element) if e.get("clip-path") or e.get("mask"))
    if clipped:
        notes.append(f"{clipped} clips or masks were not applied")
    return tuple(notes)


def _page(root: Any) -> tuple[float, float] | None:
    """Width and height of the page, mm, if both are in a unit of length."""
    from svgelements import Length

    words = root.get("width", ""), root.get("height", "")
    if not all(_LENGTH.match(word) for word in words):
        return None
    width, height = (float(Length(word).value(ppi=MM)) for word in words)
    return (width, height) if width > 0 and height > 0 else None


def _marks(root: Any, where: str) -> tuple[Mark, ...]:
    from lxml import etree
    from svgelements import SVG, Path, Shape

    try:
        page = SVG.parse(io.BytesIO(etree.tostring(root)), reify=True, ppi=MM)
        found = [
            (shape, Path(shape).reify()) for shape in page.elements() if isinstance(shape, Shape)
        ]
    except (
        ValueError,
        TypeError,
        IndexError,
        AttributeError,
        KeyError,
        ZeroDivisionError,
    ) as fault:
        raise InputError(
            "the SVG has a shape that cannot be read",
            found=f"{type(fault).__name__}: {fault}"[:200],
            where=where,
        ) from fault
    contours = [_contours(outline) for _, outline in found]
    every = [curve for group in contours for curves, _ in group for curve in curves]
    if not every:
        return ()
    points = np.concatenate(every)
    if not np.isfinite(points).all():
        raise InputError("the SVG has coordinates that are not numbers", where=where)
    tolerance = FINE * float(np.ptp(points, axis=0).max()) or FINE
    marks = []
    for (shape, _), group in zip(found, contours, strict=True):
        rings = [ring(curves, tolerance, closed=closed) for curves, closed in group]
        mark = _mark(shape, tuple(one for one in rings if one is not None))
        if mark is not None:
            marks.append(mark)
    return tuple(marks)


def _contours(path: Any) -> list[tuple[list[Floats], bool]]:
    """Control points of the curves of each contour, and whether it is closed."""
    from svgelements import Close, Move

    path.approximate_arcs_with_cubics()
    out: list[tuple[list[Floats], bool]] = []
    curves: list[Floats] = []

    def end(closed: bool) -> None:
        if curves:
            out.append((list(curves), closed))
            curves.clear()

    for segment in path:
        if isinstance(segment, Move):
            end(closed=False)
            continue
        points = [
            segment.start,
            *(getattr(segment, n, None) for n in ("control", "control1", "control2")),
            segment.end,
        ]
        known = [(float(p.x), float(p.y)) for p in points if p is not None]
        if len(known) > 1:
            curves.append(np.array(known))
        if isinstance(segment, Close):
            end(closed=True)
    end(closed=False)
    return out


def _mark(shape: Any, rings: tuple[Ring, ...]) -> Mark | None:
    """Say what of a shape is painted; None if nothing is."""
    fill, stroke = _tone(shape.fill), _tone(shape.stroke)
    rule = shape.values.get("fill-rule", "nonzero")
    width = float(shape.implicit_stroke_width or 0.0)
    drawn = stroke is not None and stroke < PAPER and width > 0
    if not rings or (fill is None and not drawn):
        return None
    return Mark(
        rings,
        fill=None if fill is None else "evenodd" if rule == "evenodd" else "nonzero",
        paper=fill is not None and fill >= PAPER,
        width=width if drawn else None,
    )


def _tone(colour: Any) -> float | None:
    """Brightness of a paint, 0 to 1; None where it paints nothing."""
    if colour is None or colour.value is None or colour.alpha == 0:
        return None
    return float((0.2126 * colour.red + 0.7152 * colour.green + 0.0722 * colour.blue) / 255)
