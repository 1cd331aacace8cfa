"""Names of the kinds of line, the stronger ones first; `kinds` says what they are."""

from collections.abc import Iterable

from relieffab.errors import InputError, suggest

PRINCIPAL = ("outline", "contour", "boundary", "crease")
"""Lines that bound a form."""
SECONDARY = (
    "suggestive",
    "ridge",
    "valley",
    "apparent-ridge",
    "suggestive-highlight",
    "principal-highlight",
)
"""Lines that tell how a form bends."""
NAMES = (*PRINCIPAL, *SECONDARY)
"""Lines that a form gives."""
DRAWN = "drawn"
"""A line that nobody found: it was drawn, or written."""
MARK = "mark"
"""A chisel's way over the surface: no line of the drawing."""
USUAL = (*PRINCIPAL, "suggestive")


def chosen(names: Iterable[str]) -> tuple[str, ...]:
    """Return the kinds named, each once, the stronger ones first.

    Raises
    ------
    InputError
        If none is named, or one that is not a kind of line.
    """
    names = tuple(names)
    for name in names:
        if name not in NAMES:
            raise InputError(
                "there is no such kind of line", found=repr(name), hint=suggest(name, NAMES)
            )
    if not names:
        raise InputError("a drawing needs a kind of line", expected="some of " + " ".join(NAMES))
    return tuple(name for name in NAMES if name in names)
