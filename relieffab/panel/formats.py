"""The names of the formats a panel is written in, without what it takes to write them."""

from collections.abc import Iterable

from relieffab.errors import InputError, suggest

FORMATS = ("stl", "3mf", "ply", "obj", "glb")
STOCK, FRAME = "stock.step", "frame.step"  # files of the uncut stock
USUAL = ("stl", "3mf")


def chosen(names: Iterable[str]) -> tuple[str, ...]:
    """Return the formats named, each once, in the order of `FORMATS`.

    Raises
    ------
    InputError
        If none is named, or one that is not a format of a panel.
    """
    names = tuple(names)
    for name in names:
        if name not in FORMATS:
            raise InputError(
                "there is no such format of a panel",
                found=repr(name),
                hint=suggest(name, FORMATS),
            )
    if not names:
        raise InputError("a panel needs a format", expected="some of " + ", ".join(FORMATS))
    return tuple(name for name in FORMATS if name in names)
