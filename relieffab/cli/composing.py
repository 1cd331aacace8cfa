"""compose: several reliefs on one panel."""

import os
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from relieffab import units
from relieffab.cli import console
from relieffab.cli.options import ComposeFlags, Json, Output, Overwrite, given
from relieffab.errors import InputError
from relieffab.job.load import gather

Part = Annotated[
    str,
    Parameter(help="FOLDER@XxY: a relief's folder, and the place of its near left corner"),
]


def _place(text: str) -> tuple[Path, tuple[float, float]]:
    folder, found, place = text.rpartition("@")
    values = units.lengths(place) if found and folder else ()
    if len(values) != 2:
        raise InputError(
            "that is no relief and its place",
            expected="FOLDER@XxY, as horse@10x10mm",
            found=text,
        )
    return Path(folder), (values[0], values[1])


def compose(
    *reliefs: Part,
    output: Output,
    flags: ComposeFlags = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> int:
    """Lay several reliefs out on one panel: FOLDER@XxY each; then panel, toolpath, template."""
    from relieffab.job import composed

    places = [_place(text) for text in reliefs]
    settings = gather({**given(flags), "model": ""}, None, os.environ)
    with console.progress_bar() as progress:
        report = composed.make(settings, places, output, overwrite=overwrite, progress=progress)
    return console.result(report, output, as_json=as_json)
