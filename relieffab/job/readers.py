"""From what a person types to the value of a setting; each raises InputError."""

from collections.abc import Callable
from typing import Any, Literal, get_args

from relieffab import units
from relieffab.errors import InputError, suggest
from relieffab.fittings import Edge, Kind
from relieffab.layers.lines.names import chosen
from relieffab.panel import formats
from relieffab.relief import names
from relieffab.template.pages import PAPERS

LONGEST = 1e5  # mm


def positive(text: Any) -> float:
    """Read a length over 0, mm."""
    value = units.length(text)
    if not 0 < value < LONGEST:
        raise InputError(
            "the length is out of range", expected="more than 0, under 100 m", found=str(text)
        )
    return value


def not_negative(text: Any) -> float:
    """Read a length of 0 or more, mm."""
    value = units.length(text)
    if not 0 <= value < LONGEST:
        raise InputError(
            "the length is out of range", expected="0 or more, under 100 m", found=str(text)
        )
    return value


def signed(text: Any) -> float:
    """Read a length either side of 0, mm."""
    value = units.length(text)
    if not -LONGEST < value < LONGEST:
        raise InputError("the length is out of range", expected="under 100 m", found=str(text))
    return value


def line_kinds(text: Any) -> tuple[str, ...]:
    """Read kinds of lines, with commas."""
    return chosen(str(text).replace(",", " ").split())


def file_formats(text: Any) -> tuple[str, ...]:
    """Read file formats, with commas."""
    return formats.chosen(str(text).lower().replace(",", " ").split())


def size(text: Any) -> tuple[float, ...]:
    """Read two lengths over 0, as 120x90mm, mm."""
    values = units.lengths(str(text))
    if len(values) != 2:
        raise InputError(
            "the size is not two lengths", expected="width x height, as 120x90mm", found=str(text)
        )
    if not all(0 < value < LONGEST for value in values):
        raise InputError(
            "the size is out of range", expected="more than 0, under 100 m", found=str(text)
        )
    return values


def places(text: Any) -> tuple[tuple[float, float], ...]:
    """Read places on the panel, as 10x80mm, 110x80mm; mm from its near left corner."""
    found = []
    for word in str(text).split(","):
        values = units.lengths(word)
        if len(values) != 2 or not all(0 <= value < LONGEST for value in values):
            raise InputError(
                "that is no place on the panel",
                expected="X x Y from its near left corner, as 10x80mm, 110x80mm",
                found=word.strip(),
            )
        found.append((values[0], values[1]))
    return tuple(found)


def outline(text: Any) -> Kind:
    """Read the name of an outline."""
    return one_of(*get_args(Kind))(text)  # type: ignore[return-value]


def edge(text: Any) -> Edge:
    """Read how an edge is broken, as chamfer 1mm."""
    kind, _, width = str(text).strip().partition(" ")
    if kind not in ("chamfer", "fillet") or not width:
        raise InputError(
            "that is no way to break an edge",
            expected="chamfer or fillet and its width, as chamfer 1mm",
            found=str(text),
        )
    return Edge(kind, positive(width))  # type: ignore[arg-type]


def resolution(text: Any) -> tuple[int, int]:
    """Read two counts of pixels, as 1024x768."""
    parts = str(text).lower().split("x")
    if len(parts) != 2 or not all(p.strip().isdigit() for p in parts):
        raise InputError(
            "the resolution is not two counts of pixels", expected="1024x768", found=str(text)
        )
    width, height = (int(p) for p in parts)
    if not (16 <= width <= 16384 and 16 <= height <= 16384):
        raise InputError(
            "the resolution is out of range",
            expected="16 to 16384 pixels each way",
            found=str(text),
        )
    return width, height


def view(text: Any) -> str:
    """Read the name of a view."""
    from relieffab.layers.view import VIEWS

    if text not in VIEWS:
        raise InputError(
            "there is no view of that name", found=str(text), hint=suggest(str(text), VIEWS)
        )
    return str(text)


def method(text: Any) -> str:
    """Read the name of a method."""
    return names.known(str(text))


def part(text: Any) -> str:
    """Read what of a relief is carved."""
    return names.part(str(text))


def rows(text: Any) -> tuple[float, bool]:
    """Read the angle of rows, degrees, and whether others cross them."""
    named = {"along": (0.0, False), "across": (90.0, False), "both": (0.0, True)}
    if str(text) in named:
        return named[str(text)]
    try:
        return units.angle(text), False
    except InputError as fault:
        raise InputError(
            "the rows' way is not known",
            expected=f"{', '.join(named)}, or an angle as 30deg",
            found=str(text),
        ) from fault


def mark_direction(text: Any) -> float | None:
    """Read the direction of marks, degrees; None where they follow the form."""
    if text == "form":
        return None
    try:
        return units.angle(text)
    except InputError as fault:
        raise InputError(
            "the marks' direction is not known",
            expected="form, or an angle as 30deg",
            found=str(text),
        ) from fault


def one_of(*words: str) -> Callable[[Any], str]:
    """Make a reader of one of a few words."""

    def read(text: Any) -> str:
        if text not in words:
            raise InputError(
                "there is no such choice", expected=" or ".join(words), found=str(text)
            )
        return str(text)

    return read


def up(text: Any) -> str:
    """Read a model's axis that points up."""
    if text not in ("y", "z"):
        raise InputError("the up axis is not known", expected="y or z", found=repr(text))
    return str(text)


def paper(text: Any) -> str:
    """Read the name of a paper size."""
    return one_of(*PAPERS)(str(text).lower())


def texture(text: Any) -> Literal["stone", "wood"]:
    """Read what a relief is pictured in."""
    return one_of("stone", "wood")(text)  # type: ignore[return-value]


def light(text: Any) -> tuple[float, float]:
    """Read where the light of a picture comes from, as 315,32.5: azimuth, elevation, degrees.

    Examples
    --------
    >>> light("-45deg, 30deg")
    (-45.0, 30.0)
    """
    words = str(text).split(",")
    if len(words) != 2:
        raise InputError(
            "the light is not two angles",
            expected="azimuth and elevation, as 315,32.5",
            found=str(text),
        )
    azimuth, elevation = (units.angle(word.strip()) for word in words)
    if not 0 < elevation <= 90:
        raise InputError(
            "the light does not stand above the panel",
            expected="an elevation over 0, at most 90 degrees",
            found=f"{elevation:g}",
        )
    return azimuth, elevation
