"""A line of text as runs of one script that read one way, from left to right as they stand."""

import unicodedata
from dataclasses import dataclass
from itertools import groupby

from relieffab.errors import InputError

_LEFTWARD, _DIGIT, _BETWEEN = ("R", "AL"), ("EN", "AN"), ("CS", "ES")
"""Classes of the Unicode bidirectional algorithm: letters, digits, what parts digits."""
_ANY = ("Zyyy", "Zinh")
"""Scripts of what goes with every script: digits, spaces, signs."""
_NUMBER = "number"


@dataclass(frozen=True)
class Run:
    """Characters to be shaped at once.

    Parameters
    ----------
    text : str
        As it is read.
    leftward : bool
        Whether it is read from right to left.
    """

    text: str
    leftward: bool


def runs_of(line: str) -> list[Run]:
    """Part a line into runs.

    Numbers are read from left to right in any script (Unicode Standard Annex 9, of
    which a line that reads one way needs no more).

    Returns
    -------
    list of Run
        The leftmost first.

    Raises
    ------
    InputError
        If the line holds letters that are read from left to right, and others that
        are read from right to left.
    """
    first: dict[str, str] = {}
    for letter in line:
        first.setdefault(unicodedata.bidirectional(letter), letter)
    leftward = [first[way] for way in _LEFTWARD if way in first]
    if leftward and "L" in first:
        raise InputError(
            "a line of this text is read both from left to right and from right to left",
            expected="one way in each line",
            found=" and ".join(
                f"{c!r} ({unicodedata.name(c, 'no name')})" for c in (first["L"], leftward[0])
            ),
            hint="a line for each (\\n parts them), or two jobs laid out by `relieffab compose`",
        )
    kinds = _kinds(line, numbers=bool(leftward))
    runs = []
    for kind, group in groupby(zip(kinds, line, strict=True), key=lambda pair: pair[0]):
        text = "".join(letter for _, letter in group)
        runs.append(Run(text, bool(leftward) and kind != _NUMBER))
    return runs[::-1] if leftward else runs


def _kinds(line: str, *, numbers: bool) -> list[str]:
    """Script of each character, that before it where it goes with any; numbers told apart."""
    from fontTools.unicodedata import script

    scripts = [script(letter) for letter in line]
    last = next((name for name in scripts if name not in _ANY), _ANY[0])
    kinds = []
    for at, name in enumerate(scripts):
        last = last if name in _ANY else name
        kinds.append(_NUMBER if numbers and _in_number(line, at) else last)
    return kinds


def _in_number(line: str, at: int) -> bool:
    """Whether a character is a digit, or a single point or the like between two."""
    way = unicodedata.bidirectional
    if way(line[at]) in _BETWEEN and 0 < at < len(line) - 1:
        return way(line[at - 1]) in _DIGIT and way(line[at + 1]) in _DIGIT
    return way(line[at]) in _DIGIT
