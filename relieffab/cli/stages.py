"""make, layers, relief, panel, template, toolpath, verify: a job, whole or stage by stage."""

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import (
    PANEL_SETTINGS,
    TEMPLATE_SETTINGS,
    TOOLPATH_SETTINGS,
    Flags,
    Json,
    Output,
    Overwrite,
    PanelFlags,
    ShowConfig,
    Source,
    TemplateFlags,
    ToolpathFlags,
    model_settings,
    settings_in,
    settings_of,
)

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
    if show_config:
        console.configuration(settings_of(source, flags), as_json=as_json)
        return 0
    settings = model_settings(source, flags)
    from relieffab.job import run

    with console.progress_bar() as progress:
        report = getattr(run, stage)(settings, output, overwrite=overwrite, progress=progress)
    return console.result(report, output, as_json=as_json)


def panel(folder: Folder, /, *, flags: PanelFlags = None, as_json: Json = False) -> int:
    """Add the solid panel, a plaque or a mould to a relief's folder: its mesh, STEP of the stock.

    Exit status 1: a cast will not come free of the mould.
    """
    from relieffab.job import run

    settings = settings_in(folder, PANEL_SETTINGS, flags)
    with console.progress_bar() as progress:
        report = run.add_panel(settings, folder, progress=progress)
    return console.result(report, folder, as_json=as_json)


def template(folder: Folder, /, *, flags: TemplateFlags = None, as_json: Json = False) -> int:
    """Add a template at 1:1 to a relief's folder, to carve it by hand: SVG and PDF pages."""
    from relieffab.job import run

    settings = settings_in(folder, TEMPLATE_SETTINGS, flags)
    with console.progress_bar() as progress:
        report = run.add_template(settings, folder, progress=progress)
    console.result(report, folder, as_json=as_json)
    return 0


def toolpath(folder: Folder, /, *, flags: ToolpathFlags = None, as_json: Json = False) -> int:
    """Add programs to a relief's folder, proved by simulation."""
    from relieffab.job import run

    settings = settings_in(folder, TOOLPATH_SETTINGS, flags)
    with console.progress_bar() as progress:
        report = run.add_toolpaths(settings, folder, progress=progress)
    console.result(report, folder, as_json=as_json)
    return 0


def verify(folder: Folder, /, *, as_json: Json = False) -> int:
    """Judge the programs in a folder as they are now: 0 they carve the relief, 1 they do not."""
    from relieffab.job import run

    part = run.verify_again(folder)
    if as_json:
        console.print_json({"verification": part})
    else:
        console.verdict(part)
    return 0 if part["ok"] else 1
