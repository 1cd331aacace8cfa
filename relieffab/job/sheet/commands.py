"""The commands that make a job again."""

import shlex
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from relieffab.job.folder import SOLIDS
from relieffab.job.sheet.words import mm
from relieffab.job.table import SETTINGS

Words = list[str]

FOLDER = "FOLDER"


def commands(report: Mapping[str, Any]) -> list[list[str]]:
    """Write the commands that make a job again, for a POSIX shell.

    They name what differs from the defaults; settings of the environment and of the
    user's own configuration would come on top.

    Parameters
    ----------
    report : mapping
        What report.json holds.

    Returns
    -------
    list of list of str
        Each command's parts, quoted, a flag with its value: where a line may be broken.
    """
    return [["relieffab", *(shlex.join(words) for words in parts)] for parts in _parts(report)]


def _parts(report: Mapping[str, Any]) -> Iterator[list[Words]]:
    settings = report["settings"]
    chosen = settings.get("solid", "panel")
    whole = "programs" in report and chosen in report and "reliefs" not in report
    yield [*_first(report, whole=whole), ["-o", FOLDER]]
    for solid in SOLIDS:
        if solid in report and not (whole and solid == chosen):
            yield [["panel"], [FOLDER], *([] if solid == "panel" else [["--solid", solid]])]
    if "programs" in report and not whole:
        yield [["toolpath"], [FOLDER]]
    if "template" in report:
        yield [["template"], [FOLDER], ["--paper", report["template"]["paper"]]]


def _first(report: Mapping[str, Any], *, whole: bool) -> list[Words]:
    """Name the command that began the job, and its flags."""
    settings = report["settings"]
    if "reliefs" in report:
        places = [
            [f"{Path(part['model']['name']).stem}@{'x'.join(map(mm, part['place_mm']))}mm"]
            for part in report["reliefs"]
        ]
        return [["compose"], *places, *_flags(settings, ("depth", "wall_angle", "solid"))]
    verb = "make" if whole else "relief" if "relief" in report else "layers"
    if not settings.get("model"):
        return [["demo"], *_flags(settings, ())]
    return [[verb], [settings["model"]], *_flags(settings, () if whole else ("solid",))]


def _flags(settings: Mapping[str, str], beside: tuple[str, ...]) -> list[Words]:
    """Write settings that differ from their defaults as flags."""
    words: list[Words] = []
    for setting in SETTINGS:
        text = settings.get(setting.name, "")
        if text and text != setting.default and setting.name not in ("model", "paper", *beside):
            words.append(["--" + setting.name.replace("_", "-"), text])
    return words
