"""A model file parsed in a process of its own: `python -m relieffab.studio.parse FILE FOLDER`.

What a stranger made may be anything, a file that takes a day or all memory among it.
"""

import json
import resource
import sys
from pathlib import Path

from relieffab.errors import InputError, RelieffabError
from relieffab.layers.mesh import read_mesh
from relieffab.studio.model import lightened, save

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
        save(lightened(read_mesh(file), file), folder)
    except MemoryError as fault:
        raise InputError(
            "the model takes more memory than the studio gives it",
            expected=f"at most {MEMORY >> 30} GiB",
            where=file.name,
            hint="fewer triangles, or the command line: relieffab make",
        ) from fault


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
