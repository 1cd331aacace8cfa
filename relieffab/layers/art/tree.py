"""An SVG's tree made plain: what its reader passes over, put into what it reads, or named.

A clip becomes a group around what it clips; its outlines come first in it, marked by
`CLIP`, and what they clip carries a mark that is inherited, `CLIPPED` and a number.
"""

import copy
import re
from collections.abc import Iterable, Iterator
from itertools import count
from typing import Any

CLIP, CLIPPED = "data-clip", "data-clipped-"
_SVG = "{http://www.w3.org/2000/svg}"
_HREFS = ("href", "{http://www.w3.org/1999/xlink}href")
_URL = re.compile(r"""^\s*url\(\s*["']?#([^"')]+)["']?\s*\)""")
_NUMBER = re.compile(r"^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(?:px)?\s*$", re.IGNORECASE)
_PLACE = ("x", "y", "width", "height")
_GONE = (
    ("script", "scripts left out"),
    ("text", "texts left out: only paths are carved"),
    ("image", "pictures left out: only paths are carved"),
    ("foreignObject", "foreign objects left out"),
)
Box = tuple[float, float, float, float]


def make_plain(root: Any) -> list[str]:
    """Change a tree so that its reader sees clips, symbols and pages within the page.

    Parameters
    ----------
    root : lxml element
        Changed in place.

    Returns
    -------
    list of str
        What was left out.
    """
    from lxml import etree

    notes = []
    for name, said in _GONE:
        found = [e for e in root.iter("{*}" + name) if e.getparent() is not None]
        for element in found:
            element.getparent().remove(element)
        notes += [f"{len(found)} {said}"] if found else []
    known = {e.get("id"): e for e in root.iter(etree.Element) if e.get("id")}
    lost = [use for use in root.iter("{*}use") if _target(use, known) is None]
    notes += [f"{told(lost)} shows what is not in this file: left out"] if lost else []
    numbers = count()
    notes += _clips(root, known, numbers)
    notes += _viewports(root, known, numbers)
    for symbol in list(root.iter(_SVG + "symbol")):  # drawn where it is used, not where it stands
        _wrapped(symbol, "defs")
    return notes


def told(elements: Iterable[Any]) -> str:
    """Name elements by what they are and their ids or lines."""
    names = []
    for element in elements:
        name, at = element.get("id"), f"in line {element.sourceline}"
        names.append(f"<{str(element.tag).rpartition('}')[2]}> {repr(name) if name else at}")
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def style(element: Any, name: str) -> str:
    """Take a property from an element's own style or attributes; empty if it is in neither."""
    found = re.search(rf"(?:^|;)\s*{name}\s*:\s*([^;]+)", element.get("style", ""))
    word = (found.group(1) if found else element.get(name, "")).strip()
    return "" if word == "none" else word


def _without(element: Any, name: str) -> None:
    """Take a property away from an element's own style and attributes."""
    element.attrib.pop(name, None)
    if "style" in element.attrib:
        kept = re.sub(rf"(^|;)\s*{name}\s*:[^;]*", r"\1", element.get("style"))
        element.set("style", kept)


def _target(element: Any, known: dict[str, Any]) -> Any:
    href = next((element.get(name) for name in _HREFS if element.get(name)), "")
    return known.get(href[1:]) if href.startswith("#") else None


def _wrapped(element: Any, tag: str) -> Any:
    """Put an element into a new one, which takes its place."""
    from lxml import etree

    group = etree.Element(_SVG + tag)
    group.tail, element.tail = element.tail, None
    element.getparent().replace(element, group)
    group.append(element)
    return group


def _clip(element: Any, outlines: Iterable[Any], transform: str, number: int) -> None:
    """Put an element into a group with outlines that clip it, in the element's own coordinates."""
    from lxml import etree

    group = _wrapped(element, "g")
    for name in ("transform", "id"):  # who uses it, uses the clip
        if element.get(name):
            group.set(name, element.attrib.pop(name))
    area = etree.Element(_SVG + "g", {CLIP: str(number), "transform": transform})
    for outline in outlines:
        area.append(copy.deepcopy(outline))
    for one in area.iter(etree.Element):
        one.attrib.pop("id", None)
    group.insert(0, area)
    element.set(f"{CLIPPED}{number}", "1")


def _clips(root: Any, known: dict[str, Any], numbers: Iterator[int]) -> list[str]:
    """Apply clips that are in their shape's own coordinates; name the others, and masks."""
    from lxml import etree

    left, masked = [], []
    for element in list(root.iter(etree.Element)):
        named = style(element, "clip-path")
        if style(element, "mask"):
            masked.append(element)
        for name in ("clip-path", "mask"):
            _without(element, name)
        if not named:
            continue
        found = _URL.match(named)
        path = known.get(found.group(1)) if found else None
        free = not any(e.tag == _SVG + "clipPath" for e in (element, *element.iterancestors()))
        own = path is not None and path.get("clipPathUnits") != "objectBoundingBox"
        if path is not None and own and free and element is not root:
            _clip(element, path, path.get("transform", ""), next(numbers))
        else:
            left.append(element)
    said = [(left, "clip"), (masked, "mask")]
    return [f"{told(some)}: its {what} is not applied" for some, what in said if some]


def _viewports(root: Any, known: dict[str, Any], numbers: Iterator[int]) -> list[str]:
    """Turn pages within the page, and symbols' own pages, into transforms."""
    room = _box(root.get("viewBox")) or (0.0, 0.0, *_sides(root))
    pages = [(inner, inner) for inner in list(root.iter(_SVG + "svg"))[1:]]
    for use in root.iter(_SVG + "use"):
        shown = _target(use, known)
        if shown is not None and shown.tag == _SVG + "symbol" and shown.get("viewBox"):
            pages.append((use, shown))
    odd = []
    for element, page in pages:
        place = _place(element, room)
        if place is None:
            odd.append(element)
            continue
        _set_out(element, page, place, numbers)
        if element is page:
            element.tag = _SVG + "g"
    return [f"{told(odd)}: its place is not in the page's own units, and not heeded"] if odd else []


def _set_out(element: Any, page: Any, place: Box, numbers: Iterator[int]) -> None:
    from lxml import etree

    x, y, width, height = place
    if style(page, "overflow") != "visible":
        hair = 1e-3 * max(width, height)  # lines on the edge stay
        box = (x - hair, y - hair, width + 2 * hair, height + 2 * hair)
        edge = etree.Element(_SVG + "rect", dict(zip(_PLACE, map(str, box), strict=True)))
        _clip(element, [edge], "", next(numbers))
    inner = _box(page.get("viewBox"))
    aspect = page.get("preserveAspectRatio", "")
    for name in (*_PLACE, *(("viewBox", "preserveAspectRatio") if element is page else ())):
        element.attrib.pop(name, None)
    moved = f"translate({x},{y})" if inner is None else _fitted(place, inner, aspect)
    element.set("transform", f"{element.get('transform', '')} {moved}")


def _fitted(place: Box, inner: Box, aspect: str) -> str:
    """Say how a viewBox lies in its viewport (SVG 2, Sect. 8.2)."""
    x, y, width, height = place
    left, top, wide, high = inner
    across, down = width / wide, height / high
    if not aspect.startswith("none"):
        across = down = max(across, down) if aspect.endswith("slice") else min(across, down)
    share = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    at = [share.get(aspect[k : k + 3], 0.5) for k in (1, 5)]
    x += at[0] * (width - across * wide)
    y += at[1] * (height - down * high)
    return f"translate({x},{y}) scale({across},{down}) translate({-left},{-top})"


def _place(element: Any, room: Box) -> Box | None:
    usual = (0.0, 0.0, *room[2:])
    told = [_number(element.get(name), value) for name, value in zip(_PLACE, usual, strict=True)]
    found = [value for value in told if value is not None]
    if len(found) < 4 or min(found[2:]) <= 0:
        return None
    return (found[0], found[1], found[2], found[3])


def _number(word: str | None, usual: float) -> float | None:
    if word is None or word.strip() == "100%":
        return usual
    found = _NUMBER.match(word)
    return float(found.group(1)) if found else None


def _sides(root: Any) -> tuple[float, float]:
    wide, high = (_number(root.get(name), 0.0) or 0.0 for name in ("width", "height"))
    return wide, high


def _box(words: str | None) -> Box | None:
    """Read a viewBox; None if there is none that has an area."""
    told = [_number(word, 0.0) for word in re.split(r"[\s,]+", (words or "").strip()) if word]
    found = [value for value in told if value is not None]
    if len(found) != 4 or min(found[2:]) <= 0:
        return None
    return (found[0], found[1], found[2], found[3])
