"""What relieffab says when it cannot go on: one class per exit status."""

import difflib
from collections.abc import Iterable

_WORDS = {"hint": "try"}


class RelieffabError(Exception):
    """A fault the person at the keyboard can act on.

    Parameters
    ----------
    message : str
        What went wrong, one sentence.
    expected, found, where, hint : str, optional
        What would have been right, what was there instead, in which file or
        option, and what to do next.  Each is printed on a line of its own.

    Attributes
    ----------
    message : str
    parts : dict of str
        Those of the others that were given, by name.
    """

    exit_status = 2

    def __init__(
        self,
        message: str,
        *,
        expected: str = "",
        found: str = "",
        where: str = "",
        hint: str = "",
    ) -> None:
        given = {"expected": expected, "found": found, "where": where, "hint": hint}
        self.message = message
        self.parts = {name: text for name, text in given.items() if text}
        lines = [f"  {_WORDS.get(name, name)}: {text}" for name, text in self.parts.items()]
        super().__init__("\n".join([message, *lines]))


class InputError(RelieffabError):
    """A file, a value or a combination of values that cannot be worked with."""


class FindingsError(RelieffabError):
    """The work was done and what it found must stop the job: a gouge, say."""

    exit_status = 1


class MachineError(RelieffabError):
    """The machine, or the line to it, refused or fell silent."""

    exit_status = 3


def suggest(word: str, known: Iterable[str]) -> str:
    """Say which known word was probably meant, else list them all.

    Examples
    --------
    >>> suggest("3018-prover", ["3018-pro", "3018-prover", "shapeoko-3"])
    'did you mean 3018-prover?'
    >>> suggest("oak", ["marble", "slate"])
    'one of: marble, slate'
    """
    names = sorted(known)
    close = difflib.get_close_matches(word.lower(), names, n=1)
    return f"did you mean {close[0]}?" if close else "one of: " + ", ".join(names)
