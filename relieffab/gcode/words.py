"""A line of G-code into words, and what Grbl says of those it does not take."""

import re

from relieffab.errors import InputError
from relieffab.gcode.dialect import Dialect

# The numbers and their meanings are those of Grbl 1.1 (doc/csv/error_codes_en_US.csv).
MEANING = {
    1: "a word does not begin with a letter",
    2: "a word has no number, or a badly written one",
    4: "a negative value where only a positive one makes sense",
    11: "the line is longer than the controller's buffer",
    20: "an unsupported command",
    21: "two commands of one modal group in a line",
    22: "a cutting move without a feed",
    23: "a command needs a whole number",
    25: "a word is repeated in a line",
    26: "a command lacks its axis words",
    27: "a line number out of range",
    28: "a command lacks a value word",
    31: "axis words that no command uses",
    32: "an arc needs X or Y",
    33: "an arc whose end does not lie on its circle",
    34: "an arc whose radius is too small for its end",
    35: "an arc needs I, J or R",
    36: "a value word that no command uses",
}

_WORD = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))|(.)")
_COMMENT = re.compile(r"\([^)]*\)?|;.*")
_TO_THE_END = re.compile(r";.*")
_ACTS_ANYWHERE = re.compile(r"[!~?]|[^\t\r\n -~]")

Words = list[tuple[str, str, str]]


def refused(code: int, where: str, found: str, hint: str = "") -> InputError:
    """Make the error that Grbl answers with, in words."""
    return InputError(f"Grbl error {code}: {MEANING[code]}", found=found, where=where, hint=hint)


def check_bytes(text: str, name: str) -> None:
    """Refuse characters that a controller obeys even within comments."""
    bad = _ACTS_ANYWHERE.search(text)
    if bad:
        raise InputError(
            "a character the controller would act on at once",
            expected="plain ASCII without ! ~ ?",
            found=repr(bad[0]),
            where=f"{name} line {text.count(chr(10), 0, bad.start()) + 1}",
        )


def split(raw: str, where: str, dialect: Dialect) -> Words:
    """Split a line into (letter, number, '') words; comments and blanks drop out.

    Parameters
    ----------
    raw : str
        The line as it stands in the file.
    where : str
        File and line, for messages.
    dialect : Dialect
        Which says how comments look, and how long a line may be.
    """
    text = raw.upper()
    if "(" in text or ";" in text:
        text = (_COMMENT if dialect.comments == "(" else _TO_THE_END).sub("", text)
    if " " in text or "\t" in text or "\r" in text:
        text = "".join(text.split())
    if len(text) > dialect.characters:
        raise refused(11, where, f"{len(text)} characters")
    words = _WORD.findall(text)
    for word in words:
        if word[2]:
            raise _not_a_word(word[2], text, where)
    return words


def _not_a_word(character: str, text: str, where: str) -> InputError:
    if character == "$":
        return InputError("a system command has no place in a program", found=text, where=where)
    if character == "/":
        return InputError(
            "a line to be left out on demand", found=text, where=where, hint="remove it, or its /"
        )
    return refused(2 if character.isalpha() else 1, where, text)
