"""demo and init: the first things a newcomer does."""

import os
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import Flags, Json, Overwrite, settings_of
from relieffab.errors import InputError

SIMULATED = "sim://?speed=max"


def demo(
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="folder for the files")] = Path(
        "relieffab-demo"
    ),
    flags: Flags = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> int:
    """Carve a scarab: model, panel, programs, and a simulated machine that runs one."""
    from relieffab.cli.send import stream
    from relieffab.job import run

    with console.progress_bar() as progress:
        report = run.make(settings_of(None, flags), output, overwrite=overwrite, progress=progress)
    program = next(p["file"] for p in report["programs"] if "02-finish" in p["file"])
    console.message(f"streaming {output / program} to a simulated Grbl machine")
    sent = stream((output / program).read_text(encoding="ascii"), SIMULATED)
    status = console.result(report, output, as_json=as_json)
    if not as_json:
        print(f"streamed {sent.lines:,} lines, {sent.cut_mm:,.0f} mm cut, to {SIMULATED}")
        print(f"\nLook at {(output / 'preview.png').resolve()}")
    return status


def init(
    path: Annotated[Path, Parameter(help="file to write")] = Path("job.toml"),
    /,
    *,
    overwrite: Annotated[bool, Parameter(negative="", help="replace a file that is there")] = False,
) -> int:
    """Write a commented job file with every setting at its default."""
    from relieffab.job.load import template

    if path.exists() and not overwrite:
        raise InputError(
            "the file is already there", where=str(path), hint="another name, or --overwrite"
        )
    if not path.parent.is_dir() or not os.access(path.parent, os.W_OK):
        raise InputError("the file cannot be written there", where=str(path.parent))
    path.write_text(template(), encoding="utf-8")
    print(path)
    return 0
