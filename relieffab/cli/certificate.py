"""Whether a program is the one that was verified: its SHA-256 in the report beside it."""

import hashlib
import json
from pathlib import Path

from relieffab.errors import InputError


def check_certificate(program: Path) -> str:
    """Compare a program with the hash that `report.json` beside it has for it.

    Returns
    -------
    str
        A note for the person where nothing vouches for the program; else empty.

    Raises
    ------
    InputError
        If the program is not the one that was verified.
    """
    report = program.parent / "report.json"
    if not report.is_file():
        return "no report.json beside the program: nothing vouches for it"
    try:
        parts = json.loads(report.read_text(encoding="utf-8")).get("programs", [])
        known = {part["file"]: part.get("sha256") for part in parts}
    except (json.JSONDecodeError, UnicodeDecodeError, KeyError, TypeError, AttributeError) as error:
        raise InputError(
            "the report cannot be read", found=str(error), where=str(report)
        ) from error
    expected = known.get(program.name)
    if expected is None:
        return f"report.json has no hash of {program.name}: nothing vouches for it"
    with program.open("rb") as file:
        found = hashlib.file_digest(file, "sha256").hexdigest()
    if found != expected:
        raise InputError(
            "the program was changed after it was verified",
            expected=f"SHA-256 {expected}",
            found=found,
            where=str(program),
            hint="make it anew with relieffab toolpath",
        )
    return ""
