"""studio: the local page."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import Flags, settings_of

Model = Annotated[str | None, Parameter(help="model file, or a job file (JOB.toml)")]


def studio(
    source: Model = None,
    /,
    *,
    output: Annotated[
        Path, Parameter(name=["--output", "-o"], help="folder below which jobs get theirs")
    ] = Path("relieffab-studio"),
    flags: Flags = None,
    port: Annotated[int, Parameter(help="of this computer; 0 for any that is free")] = 0,
    browser: Annotated[bool, Parameter(negative="--no-browser", help="open one")] = True,
) -> int:
    """Try a relief by eye on a page of this computer, then make it; Ctrl-C ends it."""
    settings = settings_of(source, flags)
    from relieffab.studio.serve import serve

    serve(settings, output, port=port, browser=browser, announce=_announce)
    return 0


def _announce(address: str) -> None:
    print(address, flush=True)
    console.message("the studio is open at that address, on this computer alone; Ctrl-C ends it")
