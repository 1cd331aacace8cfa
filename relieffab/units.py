"""Lengths, angles and feeds as a person types them; millimetres and degrees inside."""

import re

from relieffab.errors import InputError, suggest

MM_PER = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, '"': 25.4, "ft": 304.8}
DEGREES_PER = {"deg": 1.0, "°": 1.0, "rad": 57.29577951308232}
BYTES_PER = {
    **{"B": 1.0, "kB": 1e3, "KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12},
    **{"KiB": 2.0**10, "MiB": 2.0**20, "GiB": 2.0**30, "TiB": 2.0**40},
}
PER_MINUTE = {"min": 1.0, "s": 60.0, "sec": 60.0}

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*([^\s\d]*)\s*$")


def _split(text: str, kind: str, example: str) -> tuple[float, str]:
    match = _QUANTITY.match(text)
    if match is None:
        raise InputError(
            f"this is not {kind}",
            expected=f"a number with a unit, as in {example}",
            found=repr(text),
        )
    return float(match[1]), match[2]


def _scale(unit: str, table: dict[str, float], kind: str, text: str) -> float:
    if unit and unit not in table:
        raise InputError(
            f"unknown unit of {kind}", found=f"{unit!r} in {text!r}", hint=suggest(unit, table)
        )
    return table[unit] if unit else 1.0


def length(text: str | float) -> float:
    """Read a length; a bare number is millimetres.

    Parameters
    ----------
    text : str or float
        Such as ``"6mm"``, ``"0.25in"``, ``"1.2 cm"`` or ``6``.

    Returns
    -------
    float
        The length in mm.

    Raises
    ------
    InputError
        If there is no number, or the unit is not known.

    Examples
    --------
    >>> length("0.25in")
    6.35
    >>> length(4)
    4.0
    """
    if isinstance(text, (int, float)):
        return float(text)
    value, unit = _split(text, "a length", "6mm or 0.25in")
    return value * _scale(unit, MM_PER, "length", text)


def lengths(text: str) -> tuple[float, ...]:
    """Read lengths joined by ``x``; a unit at the end serves those without one.

    Examples
    --------
    >>> lengths("120x90mm")
    (120.0, 90.0)
    >>> lengths("4in x 3in x 1cm")
    (101.6, 76.19999999999999, 10.0)
    """
    parts = re.split(r"\s*[xX×]\s*", text.strip())  # noqa: RUF001
    last_unit = _split(parts[-1], "a size", "120x90mm")[1]
    units = [_split(part, "a size", "120x90mm")[1] for part in parts]
    return tuple(
        length(part if unit else part + last_unit) for part, unit in zip(parts, units, strict=True)
    )


def angle(text: str | float) -> float:
    """Read an angle in degrees; a bare number is degrees.

    Examples
    --------
    >>> angle("30deg")
    30.0
    """
    if isinstance(text, (int, float)):
        return float(text)
    value, unit = _split(text, "an angle", "30deg")
    return value * _scale(unit, DEGREES_PER, "angle", text)


def feed(text: str | float) -> float:
    """Read a feed in mm/min; a bare number is mm/min.

    Examples
    --------
    >>> feed("10mm/s")
    600.0
    """
    if isinstance(text, (int, float)):
        return float(text)
    value, unit = _split(text, "a feed", "800mm/min")
    over, _, under = unit.partition("/")
    scale = _scale(over, MM_PER, "length", text)
    return value * scale * _scale(under, PER_MINUTE, "time", text)


def memory(text: str) -> int:
    """Read a size of memory, in bytes; it needs its unit.

    Examples
    --------
    >>> memory("4GiB")
    4294967296
    """
    value, unit = _split(text, "a size of memory", "4GiB")
    if not unit or value <= 0:
        raise InputError(
            "this is not a size of memory", expected="such as 4GiB or 800MB", found=repr(text)
        )
    return int(value * _scale(unit, BYTES_PER, "memory", text))


def memory_text(count: float) -> str:
    """Write a size of memory, in bytes, as a person reads it.

    Examples
    --------
    >>> memory_text(4294967296), memory_text(3e8)
    ('4.0 GiB', '286 MiB')
    """
    return f"{count / 2**30:.1f} GiB" if count >= 2**30 else f"{count / 2**20:.0f} MiB"
