"""make, layers, relief, panel, toolpath, verify: a job, whole or stage by stage."""

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import (
    Flags,
    Json,
    Output,
    Overwrite,
    ShowConfig,
    flags_over,
    settings_of,
)

Source = Annotated[str, Parameter(help="model file, or a job file (JOB.toml)")]
Folder = Annotated[Path, Parameter(help="folder that `relieffab relief` or `make` left")]


def make(
    source: Source,
    /,
    *,
    output: Output,
    flags: Flags = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
    show_config: ShowConfig = False,
) -> int:
    """Carve a model: layers, relief, panel, programs, proved by simulation."""
    return _from_model("make", source, output, flags, overwrite, as_json, show_config)


def layers(
    source: Source,
    /,
    *,
    output: Output,
    flags: Flags = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
    show_config: ShowConfig = False,
) -> int:
    """See a model: depth, shading and line drawing."""
    return _from_model("make_layers", source, output, flags, overwrite, as_json, show_config)


def relief(
    source: Source,
    /,
    *,
    output: Output,
    flags: Flags = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
    show_config: ShowConfig = False,
) -> int:
    """Turn a model into a relief: layers and height field."""
    return _from_model("make_relief", source, output, flags, overwrite, as_json, show_config)


def _from_model(
    stage: str,
    source: str,
    output: Path,
    flags: Any,
    overwrite: bool,
    as_json: bool,
    show_config: bool,
) -> int:
    settings = settings_of(source, flags)
    if show_config:
        console.configuration(settings, as_json=as_json)
        return 0
    from relieffab.job import run

    with console.progress_bar() as progress:
        report = getattr(run, stage)(settings, output, overwrite=overwrite, progress=progress)
    console.result(report, output, as_json=as_json)
    return 0


def panel(folder: Folder, /, *, flags: Flags = None, as_json: Json = False) -> int:
    """Add the solid panel to a relief's folder: STL, 3MF, STEP of the stock."""
    return _in_folder("add_panel", folder, flags, as_json)


def toolpath(folder: Folder, /, *, flags: Flags = None, as_json: Json = False) -> int:
    """Add programs to a relief's folder, proved by simulation."""
    return _in_folder("add_toolpaths", folder, flags, as_json)


def _in_folder(stage: str, folder: Path, flags: Any, as_json: bool) -> int:
    from relieffab.job import run
    from relieffab.job.report import read_report

    settings = flags_over(read_report(folder), flags)
    with console.progress_bar() as progress:
        report = getattr(run, stage)(settings, folder, progress=progress)
    console.result(report, folder, as_json=as_json)
    return 0


def verify(folder: Folder, /, *, as_json: Json = False) -> int:
    """Judge the programs in a folder as they are now: 0 they carve the relief, 1 they do not."""
    from relieffab.job import run
    from relieffab.job.report import read_report

    report = run.verify_again(flags_over(read_report(folder), None), folder)
    if as_json:
        console.result({"verification": report["verification"]}, folder, as_json=True)
    else:
        console.verdict(report["verification"])
    return 0 if report["verification"]["ok"] else 1
