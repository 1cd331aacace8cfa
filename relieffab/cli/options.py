"""The settings of a job as flags: made from the one table of settings."""

import os
from dataclasses import asdict, field, make_dataclass
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from relieffab.job.load import gather
from relieffab.job.settings import SETTINGS, Chosen

# Given as the command's argument, not as a flag.
_POSITIONAL = ("model",)


def _flag(name: str, text: str, default: str) -> tuple[str, Any, Any]:
    about = f"{text} (default {default})" if default else text
    hint = Annotated[str | None, Parameter(help=about, allow_leading_hyphen=True)]
    return name, hint, field(default=None)


Options = make_dataclass(
    "Options",
    [_flag(s.name, s.help, s.default) for s in SETTINGS if s.name not in _POSITIONAL],
    frozen=True,
)
Options.__module__ = __name__  # as Python 3.12's make_dataclass(module=...) would set it
Options.__doc__ = "Flags of a job; what is not given comes from elsewhere."

Flags = Annotated[Options | None, Parameter(name="*")]  # type: ignore[valid-type]
Output = Annotated[Path, Parameter(name=["--output", "-o"], help="folder for the files")]
Overwrite = Annotated[
    bool, Parameter(negative="", help="replace the files of a job that is already there")
]
Json = Annotated[bool, Parameter(name="--json", negative="", help="print the report as JSON")]
ShowConfig = Annotated[
    bool, Parameter(negative="", help="print every setting with its origin, and stop")
]


def settings_of(source: str | None, flags: Any) -> dict[str, Chosen]:
    """Resolve settings for a model or a job file, with flags over both.

    Parameters
    ----------
    source : str or None
        A model, or a job file if it ends in .toml.
    flags : Options or None
    """
    given = {name: text for name, text in asdict(flags or Options()).items() if text is not None}
    job_file = None
    if source is not None and source.lower().endswith(".toml"):
        job_file = Path(source)
    elif source is not None:
        given["model"] = source
    return gather(given, job_file, os.environ)


def flags_over(report: dict[str, Any], flags: Any) -> dict[str, Chosen]:
    """Resolve settings for a folder that a job left: flags over what it was made with."""
    from relieffab.job.settings import resolve

    given = {name: text for name, text in asdict(flags or Options()).items() if text is not None}
    return resolve([("flag", given), ("report.json", report.get("settings", {}))])
