"""The names of the ways to make a relief, without what it takes to make one."""

from relieffab.errors import InputError, suggest

SUNKEN = "sunken"
CLASSIC = ("linear", "gradient", "bilateral", "histogram", "weyrich", "wang")
NAMES = (SUNKEN, *CLASSIC)
ALL, SURFACE, LINES = PARTS = ("all", "surface", "lines")


def known(name: str) -> str:
    """Return the name of a method.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    if name not in NAMES:
        raise InputError("there is no method of that name", found=name, hint=suggest(name, NAMES))
    return name


def part(name: str) -> str:
    """Return the name of what is carved: everything, the surface or the lines alone.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    if name not in PARTS:
        raise InputError(
            "nothing of that name can be carved", found=name, expected=", ".join(PARTS)
        )
    return name
