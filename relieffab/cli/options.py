"""The settings of a job as flags: made from the one table of settings."""

import os
from collections.abc import Iterable
from dataclasses import asdict, field, make_dataclass
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from relieffab.errors import InputError
from relieffab.job.load import from_environment, gather
from relieffab.job.report import read_report
from relieffab.job.settings import Chosen, resolve
from relieffab.job.table import TABLE, Setting

# What `panel` and `toolpath` may still choose; the rest was settled by the relief.
PICTURE_SETTINGS = ("light", "texture")
ROUND_SETTINGS = ("round", "bore", "floor", "curved")
PANEL_SETTINGS = (
    *("mesh_tolerance", "formats", "solid", "draft", "bed", "clearance"),
    *PICTURE_SETTINGS,
    *ROUND_SETTINGS,
)
TOOLPATH_SETTINGS = (
    *("machine", "material", "rough", "finish", "lines", "stepover", "scallop", "rows", "milling"),
    *("units", "work_zero", "work_zero_z", "positions", "overlap", "plate", "cutter_change"),
    *PICTURE_SETTINGS,
)
TEMPLATE_SETTINGS = ("paper",)
STOCK_SETTINGS = (
    "outline", "corner", "frame", "frame_height", "frame_edge", "holes", "hole", "countersink",
    "keyholes", *ROUND_SETTINGS,
)  # fmt: skip
STYLE_SETTINGS = (
    "style", "mark_spacing", "mark_depth", "mark_direction", "mark_cutter", "ground",
)  # fmt: skip
# What makes no difference between methods, or is what `compare` goes through.
_NOT_COMPARED = (
    "depth", "method", "thickness", *STYLE_SETTINGS, *STOCK_SETTINGS, *PANEL_SETTINGS,
    *TEMPLATE_SETTINGS,
    *(name for name in TOOLPATH_SETTINGS if name != "lines"),
)  # fmt: skip


def _flags(name: str, settings: Iterable[str]) -> type:
    """Make a dataclass with one optional field a setting."""
    made = make_dataclass(name, [_flag(TABLE[setting]) for setting in settings], frozen=True)
    made.__module__ = __name__  # as Python 3.12's make_dataclass(module=...) would set it
    made.__doc__ = "Flags of a job; what is not given comes from elsewhere."
    return made


def _flag(setting: Setting) -> tuple[str, Any, Any]:
    default = f" (default {setting.default})" if setting.default else ""
    hint = Annotated[str | None, Parameter(help=setting.help + default, allow_leading_hyphen=True)]
    return setting.name, hint, field(default=None)


# The model is the command's argument, not a flag; no job leaves a template of its own accord.
Options = _flags("Options", [n for n in TABLE if n not in ("model", *TEMPLATE_SETTINGS)])
PanelOptions = _flags("PanelOptions", PANEL_SETTINGS)
ToolpathOptions = _flags("ToolpathOptions", TOOLPATH_SETTINGS)
ComposeOptions = _flags("ComposeOptions", ("size", "thickness", *STOCK_SETTINGS, *PICTURE_SETTINGS))
TemplateOptions = _flags("TemplateOptions", TEMPLATE_SETTINGS)
CompareOptions = _flags("CompareOptions", [n for n in TABLE if n not in ("model", *_NOT_COMPARED)])

Flags = Annotated[Options | None, Parameter(name="*")]  # type: ignore[valid-type]
PanelFlags = Annotated[PanelOptions | None, Parameter(name="*")]  # type: ignore[valid-type]
ToolpathFlags = Annotated[ToolpathOptions | None, Parameter(name="*")]  # type: ignore[valid-type]
ComposeFlags = Annotated[ComposeOptions | None, Parameter(name="*")]  # type: ignore[valid-type]
TemplateFlags = Annotated[TemplateOptions | None, Parameter(name="*")]  # type: ignore[valid-type]
CompareFlags = Annotated[CompareOptions | None, Parameter(name="*")]  # type: ignore[valid-type]
Source = Annotated[str, Parameter(help="mesh, picture, SVG or font, or a job file (JOB.toml)")]
Output = Annotated[Path, Parameter(name=["--output", "-o"], help="folder for the files")]
Overwrite = Annotated[
    bool, Parameter(negative="", help="replace the files of a job that is already there")
]
Json = Annotated[bool, Parameter(name="--json", negative="", help="print the report as JSON")]
ShowConfig = Annotated[
    bool, Parameter(negative="", help="print every setting with its origin, and stop")
]


def given(flags: Any) -> dict[str, str]:
    """Return the flags that were given, as typed."""
    if flags is None:
        return {}
    return {name: text for name, text in asdict(flags).items() if text is not None}


def settings_of(source: str | None, flags: Any) -> dict[str, Chosen]:
    """Resolve settings for a model or a job file, with flags over both.

    Parameters
    ----------
    source : str or None
        A model, or a job file if it ends in .toml; None for the scarab.
    flags : Options or None
    """
    typed = given(flags)
    if source is None:
        return gather({**typed, "model": ""}, None, os.environ)
    if not source.lower().endswith(".toml"):
        return gather({**typed, "model": source}, None, os.environ)
    return gather(typed, Path(source), os.environ)


def model_settings(source: str, flags: Any) -> dict[str, Chosen]:
    """Resolve settings as `settings_of`; refuse a job file that names no model."""
    settings = settings_of(source, flags)
    if settings["model"].value is None:
        raise InputError("the job names no model", expected='model = "FILE"', where=source)
    return settings


def settings_in(folder: Path, names: Iterable[str], flags: Any) -> dict[str, Chosen]:
    """Resolve settings for a folder that a job left.

    Flags and RELIEFFAB_* choose among `names`; all else is as the job was made,
    but for the solid: without a word it is a panel.
    """
    kept = {name: text for name, text in read_report(folder)["settings"].items() if name != "solid"}
    chosen = [
        (origin, values)
        for origin, values in from_environment(os.environ)
        if set(values) <= set(names)
    ]
    return resolve([("flag", given(flags)), *chosen, ("report.json", kept)])
