"""SVG files: their paths, flattened, in the order in which they are painted."""

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.art.art import Art, Mark, Ring
from relieffab.layers.art.clip import clipped
from relieffab.layers.art.curves import FINE, ring
from relieffab.layers.art.tree import CLIP, CLIPPED, make_plain

Floats = NDArray[np.float64]

MM = 25.4
"""Pixels to an inch that make a pixel 1 mm."""
PAPER = 0.93
"""Brightness from which a fill is the paper's own."""
LARGEST = 64_000_000
"""Bytes: no drawing is larger."""
_LENGTH = re.compile(r"^\s*[+]?[\d.]+(?:e[+-]?\d+)?\s*(mm|cm|in|pt|pc|q)\s*$", re.IGNORECASE)
_NOTHING = re.compile(r"^[-+]?(?:0+\.?0*|\.0+)(?:e[-+]?\d+)?%?$", re.IGNORECASE)
"""An opacity of 0."""


def read_svg(path: str | Path) -> Art:
    """Read the paths of an SVG: shapes, transforms, `use`, symbols, clips, viewBox, styles.

    Fills as light as paper cover what lies under them; text, pictures, scripts and
    masks are left out, and said so.

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
    notes = make_plain(root)
    shapes, plainer = _shapes(root, where)
    notes += plainer
    marks = _marks(shapes, where)
    if not marks:
        why = f" ({'; '.join(notes)})" if notes else ""
        raise InputError(
            f"the SVG has no path to be seen{why}",
            expected="paths or shapes with a fill or a stroke",
            where=where,
            hint="turn text into paths where it was drawn; give a picture as a picture",
        )
    return Art(marks, _page(root), path.name, "svg", tuple(notes))


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


def _page(root: Any) -> tuple[float, float] | None:
    """Width and height of the page, mm, if both are in a unit of length."""
    from svgelements import Length

    words = root.get("width", ""), root.get("height", "")
    if not all(_LENGTH.match(word) for word in words):
        return None
    width, height = (float(Length(word).value(ppi=MM)) for word in words)
    return (width, height) if width > 0 and height > 0 else None


def _shapes(root: Any, where: str) -> tuple[list[tuple[Any, Any]], list[str]]:
    """Read the shapes and their paths, in order; and name what is not drawn as it is painted."""
    from lxml import etree
    from svgelements import SVG, Path, Shape

    try:
        page = SVG.parse(io.BytesIO(etree.tostring(root)), reify=True, ppi=MM)
        elements = list(page.elements())
        shapes = [(each, Path(each).reify()) for each in elements if isinstance(each, Shape)]
    except (
        ValueError,
        TypeError,
        IndexError,
        AttributeError,
        KeyError,
        ZeroDivisionError,
        RecursionError,  # what is used uses itself
    ) as fault:
        raise InputError(
            "the SVG has a shape that cannot be read",
            found=f"{type(fault).__name__}: {fault}"[:200],
            where=where,
        ) from fault
    return shapes, _plainer(elements, [shape for shape, _ in shapes if not _hidden(shape)])


def _plainer(elements: list[Any], seen: list[Any]) -> list[str]:
    """Say what is drawn more plainly than it is painted."""
    by_sheet = [e for e in elements if _told(e, "clip-path") or _told(e, "mask")]
    counts = (
        (by_sheet, "clips or masks of a style sheet are not applied"),
        ([e for e in seen if _told(e, "fill").startswith("url(")],
         "gradients or patterns taken for a dark fill"),
        ([e for e in seen if _told(e, "stroke-dasharray")], "dashed lines drawn whole"),
        ([e for e in seen if _told(e, "filter")], "filters are not applied"),
        ([e for e in seen if any(_told(e, f"marker-{at}") for at in ("start", "mid", "end"))],
         "lines without their markers"),
    )  # fmt: skip
    return [f"{len(some)} {said}" for some, said in counts if some]


def _told(element: Any, name: str) -> str:
    """Return a property of an element, from wherever it has it; empty if none."""
    word = str(getattr(element, "values", {}).get(name) or "").strip()
    return "" if word == "none" else word


def _hidden(shape: Any) -> bool:
    unseen = _told(shape, "visibility") in ("hidden", "collapse")
    return unseen or _NOTHING.match(_told(shape, "opacity")) is not None


def _marks(shapes: list[tuple[Any, Any]], where: str) -> tuple[Mark, ...]:
    contours = [_contours(outline) for _, outline in shapes]
    every = [
        curve
        for (shape, _), group in zip(shapes, contours, strict=True)
        if CLIP not in shape.values
        for curves, _ in group
        for curve in curves
    ]
    if not every:
        return ()
    points = np.concatenate(every)
    if not np.isfinite(points).all():
        raise InputError("the SVG has coordinates that are not numbers", where=where)
    tolerance = FINE * float(np.ptp(points, axis=0).max()) or FINE
    marks: list[Mark] = []
    regions: dict[str, list[Mark]] = {}
    last = None
    for (shape, _), group in zip(shapes, contours, strict=True):
        found = (ring(curves, tolerance, closed=closed) for curves, closed in group)
        rings = tuple(one for one in found if one is not None)
        number = shape.values.get(CLIP)
        if number is None:
            marks += _within(_mark(shape, rings), shape, regions)
        elif rings and not _hidden(shape):
            before = regions[number] if number == last else []
            rule = "evenodd" if _told(shape, "clip-rule") == "evenodd" else "nonzero"
            regions[number] = [*before, Mark(rings, fill=rule)]
        last = number
    return tuple(marks)


def _within(mark: Mark | None, shape: Any, regions: dict[str, list[Mark]]) -> list[Mark]:
    """Cut a mark to all the clips that it is in."""
    left = [mark] if mark is not None else []
    for name in shape.values:
        if str(name).startswith(CLIPPED):
            region = regions.get(str(name).removeprefix(CLIPPED), [])
            left = [part for one in left for part in clipped(one, region)]
    return left


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
    if not rings or _hidden(shape) or (fill is None and not drawn):
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
