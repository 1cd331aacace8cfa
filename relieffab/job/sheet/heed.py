"""What a person has to heed before anything else: findings, warnings, notes."""

from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

from relieffab.job.folder import SOLIDS
from relieffab.job.sheet.reach import reach_of


class Heed(NamedTuple):
    """One thing to heed.

    Parameters
    ----------
    kind : {'finding', 'warning', 'note'}
        Stop; mind it before you cut; good to know.
    text : str
    """

    kind: Literal["finding", "warning", "note"]
    text: str


def heeds(report: Mapping[str, Any]) -> list[Heed]:
    """Gather all that is to be heeded in a job, the gravest first, each once."""
    found = [
        *(Heed("finding", text) for text in _findings(report)),
        *(Heed("warning", text) for text in _warnings(report)),
        *(Heed("note", text) for text in _notes(report)),
    ]
    return list(dict.fromkeys(found))


def _findings(report: Mapping[str, Any]) -> Iterator[str]:
    proof = report.get("verification", {})
    yield from proof.get("findings", [])
    if proof and not proof["ok"] and not proof["findings"]:
        yield "the programs do not carve the relief"
    for name in SOLIDS:
        yield from report.get(name, {}).get("findings", [])
        if report.get(name, {}).get("watertight") is False:
            yield f"the {name} is not watertight"


def _warnings(report: Mapping[str, Any]) -> Iterator[str]:
    if report.get("relief", {}).get("converged") is False:
        yield "the relief was not solved to the end: it may look unfinished"
    yield from report.get("material", {}).get("notes", [])
    for part in report.get("programs", []):
        reach = reach_of(part, report["slab"])
        if reach.short:
            yield (
                f"{part['cutter']['name']}: stands {reach.known:g} mm out of its collet by its "
                f"profile, and needs {reach.least:g} mm here"
            )
    yield from report.get("verification", {}).get("notes", [])


def _notes(report: Mapping[str, Any]) -> Iterator[str]:
    yield from report.get("model", {}).get("notes", [])
    if report.get("stock", {}).get("note"):
        yield f"no stock.step: {report['stock']['note']}"
