"""A model file parsed in a process of its own: `python -m relieffab.studio.parse FILE FOLDER`.

What a stranger made may be anything, a file that takes a day or all memory among it.
"""

import json
import resource
import sys
from pathlib import Path

from relieffab.errors import InputError, RelieffabError
from relieffab.layers.art.svg import read_svg
from relieffab.layers.content import FONT, PICTURE, SVG, content_of
from relieffab.layers.image.read import read_picture
from relieffab.layers.mesh import read_mesh
from relieffab.studio import model, sheet

MEMORY = 6 << 30
"""Bytes of address space."""
SECONDS = 120
"""Of the processor."""


def _limit() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    # The first of the two ends a process by SIGXCPU, which tells why.
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _parse(file: Path, folder: Path) -> None:
    try:
        _read(file, folder)
    except MemoryError as fault:
        raise InputError(
            "the model takes more memory than the studio gives it",
            expected=f"at most {MEMORY >> 30} GiB",
            where=file.name,
            hint="a smaller one, or the command line: relieffab make",
        ) from fault


def _read(file: Path, folder: Path) -> None:
    kind = content_of(file)
    if kind == FONT:
        raise InputError(
            "a font is there to write with, which the studio cannot do yet",
            where=file.name,
            hint="the command line: relieffab make FONT --text WORDS",
        )
    if kind == PICTURE:
        sheet.save(sheet.sheet_of_picture(read_picture(file), file), folder)
    elif kind == SVG:
        sheet.save(sheet.sheet_of_art(read_svg(file), file), folder)
    else:
        model.save(model.lightened(read_mesh(file), file), folder)


def main(arguments: list[str]) -> int:
    """Parse, and write what is wrong as JSON to stdout."""
    _limit()
    try:
        _parse(Path(arguments[0]), Path(arguments[1]))
    except RelieffabError as error:
        sys.stdout.write(json.dumps({"message": error.message, **error.parts}))
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
