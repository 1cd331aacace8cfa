"""The certificate of a job's programs: what was proved, by content, and whether it still stands.

It is asked for whenever something is sent, so it loads nothing that it takes to judge.
"""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from relieffab.errors import FindingsError
from relieffab.job.folder import REPORT
from relieffab.job.report import read_report

Part = dict[str, Any]

RELIEF = "relief.tiff"


def file_hash(path: Path) -> str:
    """Return a file's SHA-256, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def program_names(report: Mapping[str, Any]) -> list[str]:
    """Name the files of the programs, each once, in their order."""
    return list(dict.fromkeys(str(part["file"]) for part in report["programs"]))


def certificate(report: Mapping[str, Any], folder: Path) -> Part:
    """Name what was proved by its content: programs and relief."""
    names = program_names(report)
    return {
        "programs": {name: file_hash(folder / name) for name in names},
        "relief": report["relief"].get("sha256"),
    }


def check_certificate(program: Path) -> list[str] | None:
    """Ask whether a program that is about to be sent was proved as it stands.

    Parameters
    ----------
    program : Path

    Returns
    -------
    list of str or None
        What a person should know: nothing where the certificate holds.  None where the
        program or the relief was changed since: `proof.judged_again` says what it is worth.

    Raises
    ------
    FindingsError
        If it is a probe or an outline that was changed.
    InputError
        If the report cannot be read.
    """
    folder = program.parent
    if not (folder / REPORT).is_file():
        return [f"there is no {REPORT} beside {program.name}: nobody proved it"]
    report = read_report(folder)
    if program.name in (aids := {part["file"]: part["sha256"] for part in report.get("aids", [])}):
        return _check_aid(program, aids[program.name])
    if program.name not in program_names(report):
        return [f"{program.name} is none of this job's programs: nobody proved it"]
    proof = report.get("verification") or {}
    held = proof.get("certificate") or {}
    same = held.get("programs", {}).get(program.name) == file_hash(program)
    stands = same and held.get("relief") == file_hash(folder / RELIEF) and proof.get("ok") is True
    return [] if stands else None


def _check_aid(program: Path, known: str) -> list[str]:
    """Refuse a probe or an outline that is not as the job wrote it: neither can be judged."""
    if file_hash(program) != known:
        raise FindingsError(
            f"{program.name} is not as the job wrote it; nothing sent",
            where=str(program),
            hint="relieffab toolpath writes it again",
        )
    return []
