"""G-code words: a letter and a number, sorted into modal groups."""

import re
from dataclasses import dataclass, field

_WORD = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))")
_LINE = re.compile(r"(?:[A-Z][-+]?(?:\d+\.?\d*|\.\d+))*")

G_GROUPS: dict[float, int] = {
    **dict.fromkeys((4.0, 10.0, 28.0, 28.1, 30.0, 30.1, 53.0, 92.0, 92.1), 0),
    **dict.fromkeys((0.0, 1.0, 2.0, 3.0, 38.2, 38.3, 38.4, 38.5, 80.0), 1),
    **dict.fromkeys((17.0, 18.0, 19.0), 2),
    **dict.fromkeys((90.0, 91.0), 3),
    91.1: 4,
    **dict.fromkeys((93.0, 94.0), 5),
    **dict.fromkeys((20.0, 21.0), 6),
    40.0: 7,
    **dict.fromkeys((43.1, 49.0), 8),
    **dict.fromkeys((54.0, 55.0, 56.0, 57.0, 58.0, 59.0), 12),
    61.0: 13,
}
M_GROUPS: dict[int, int] = {
    **dict.fromkeys((0, 1, 2, 30), 4),
    **dict.fromkeys((3, 4, 5), 7),
    **dict.fromkeys((8, 9), 8),
}
VALUES = "FIJKLNPRST"
_NEVER_NEGATIVE = "FNPST"


class Refused(Exception):  # noqa: N818
    """Grbl's `error:code`."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


@dataclass
class Words:
    """One line, sorted.

    Parameters
    ----------
    g : dict
        Modal group -> G number.
    m : dict
        Modal group -> M number.
    values : dict
        Letter -> number, as written.
    """

    g: dict[int, float] = field(default_factory=dict)
    m: dict[int, int] = field(default_factory=dict)
    values: dict[str, float] = field(default_factory=dict)


def read_words(line: str, axes: str = "XYZ") -> Words:
    """Sort a line without spaces and comments into words, or refuse it as Grbl does."""
    words = Words()
    for letter, number in _WORD.findall(line, 0, _well_formed(line)):
        value = float(number)
        if letter == "G":
            _put(words.g, G_GROUPS, round(value, 2))
        elif letter == "M":
            if value != int(value):
                raise Refused(23)
            _put(words.m, M_GROUPS, int(value))
        else:
            _value(words, letter, value, axes)
    return words


def _well_formed(line: str) -> int:
    """Length of the line, if it is nothing but words."""
    match = _LINE.match(line)
    end = match.end() if match else 0
    if end < len(line):
        raise Refused(2 if line[end].isalpha() else 1)
    return end


def _put(into: dict, groups: dict, code: float) -> None:
    group = groups.get(code)
    if group is None:
        raise Refused(20)
    if group in into:
        raise Refused(21)
    into[group] = code


def _value(words: Words, letter: str, value: float, axes: str) -> None:
    if letter not in VALUES and letter not in axes:
        raise Refused(20)
    if letter in words.values:
        raise Refused(25)
    if value < 0 and letter in _NEVER_NEGATIVE:
        raise Refused(4)
    words.values[letter] = value
