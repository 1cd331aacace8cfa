"""One line of a program: cleaned as Grbl would, and refused where Grbl would misread it."""

import re

from relieffab.errors import InputError

LONGEST_LINE = 79
"""Significant characters Grbl takes in one line; one more is error 11."""

_COMMENT = re.compile(r"\([^)]*\)?|;.*")
_WORDS = re.compile(r"(?:[A-Z][-+]?(?:\d+\.?\d*|\.\d+))+")
_SETTING = re.compile(r"\$(?:\d{1,3}=-?\d+\.?\d*|N[01]=(?:[A-Z][-+]?(?:\d+\.?\d*|\.\d+))*)")
_STORES = re.compile(r"G0*10(?:\.0*)?(?![\d.])|G0*(?:28|30)\.10*(?!\d)")
_PAUSE = re.compile(r"M0+(?![\d.])")
_G4 = r"G0*4(?:\.0*)?(?![\d.])"
_DWELL = re.compile(rf"{_G4}.*?P\+?([\d.]+)|P\+?([\d.]+).*?{_G4}")


def clean(line: str) -> str:
    """Take comments and white space out of a line, as Grbl would, and raise its case.

    Examples
    --------
    >>> clean("g1 x1.5 (across) y-2 ; back")
    'G1X1.5Y-2'
    >>> clean("%")
    ''
    """
    if "(" in line or ";" in line:
        line = _COMMENT.sub("", line)
    bare = "".join(line.split()).upper()
    return "" if bare == "%" else bare


def check(line: str, number: int) -> None:
    """Refuse what must not reach the wire.

    Parameters
    ----------
    line : str
        Clean.
    number : int
        Its line in the source.

    Raises
    ------
    InputError
    """
    where = f"line {number}"
    if len(line) > LONGEST_LINE:
        raise InputError(
            "the line is too long for Grbl",
            expected=f"at most {LONGEST_LINE} characters without spaces and comments",
            found=f"{len(line)}",
            where=where,
        )
    if line.startswith("$"):
        if _SETTING.fullmatch(line) is None:
            raise InputError(
                "a program may hold no $ commands but settings",
                expected="G-code, or a setting such as $110=1000",
                found=line,
                where=where,
                hint="home, unlock and check the machine before the program is sent",
            )
    elif _WORDS.fullmatch(line) is None:
        raise InputError(
            "the line is not G-code",
            expected="words of a letter and a number, plain ASCII",
            found=ascii(line),
            where=where,
            hint="some other characters (! ~ ? and all beyond ASCII) command Grbl at once",
        )


def stores(line: str) -> bool:
    """Say whether Grbl writes its EEPROM on this line, and so loses bytes that arrive.

    Examples
    --------
    >>> stores("G10L2P1X0"), stores("$110=900"), stores("G28")
    (True, True, False)
    """
    return line.startswith("$") or ("G" in line and _STORES.search(line) is not None)


def homes(line: str) -> bool:
    """Say whether the machine homes on this line; it answers nothing meanwhile."""
    return line == "$H"


def pauses(line: str) -> bool:
    """Say whether the line waits for a person (M0)."""
    return "M0" in line and _PAUSE.search(line) is not None


def dwell_seconds(line: str) -> float:
    """Seconds that a G4 on this line waits.

    Examples
    --------
    >>> dwell_seconds("G4P2.5")
    2.5
    """
    match = _DWELL.search(line) if "P" in line else None
    return float(match[1] or match[2]) if match else 0.0
