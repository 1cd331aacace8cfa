"""send and machines: what concerns the machine itself."""

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import Json
from relieffab.errors import InputError

if TYPE_CHECKING:
    from relieffab.grbl.sender import SendReport


def send(
    program: Annotated[Path, Parameter(help="G-code file")],
    /,
    *,
    port: Annotated[str, Parameter(help="serial port, or sim:// for the simulated machine")],
    baud: Annotated[int, Parameter(help="bits a second")] = 115200,
    as_json: Json = False,
) -> int:
    """Stream a program to a Grbl machine and see it through."""
    if not program.is_file():
        raise InputError("there is no such program", where=str(program))
    from relieffab.job.proof import check_certificate

    for note in check_certificate(program):
        console.message(f"note: {note}")
    report = stream(program.read_text(encoding="latin-1"), port, baud)
    if as_json:
        print(json.dumps(asdict(report), indent=2))
    else:
        print(f"carved {report.cut_mm:,.0f} mm in {report.lines:,} lines")
    return 0


def stream(text: str, url: str, baud: int = 115200) -> "SendReport":
    """Send text through a port with a bar that counts the millimetres cut."""
    from relieffab.grbl.port import open_port
    from relieffab.grbl.sender import send as send_program

    with open_port(url, baud=baud) as port, console.progress_bar() as progress:
        report = send_program(text, port, progress=progress)
    for note in report.notes:
        console.message(f"note: {note}")
    return report


def machines(
    kind: Annotated[
        Literal["machines", "cutters", "materials"], Parameter(help="which profiles")
    ] = "machines",
    name: Annotated[str | None, Parameter(help="one profile, whole")] = None,
    /,
    *,
    as_json: Json = False,
) -> int:
    """List machines, cutters or materials, or print one."""
    from relieffab import profiles

    read: dict[str, Callable[[str], Any]] = {
        "machines": profiles.machine,
        "cutters": profiles.cutter,
        "materials": profiles.material,
    }
    chosen = [read[kind](one) for one in ([name] if name else profiles.names(kind))]
    if as_json:
        print(json.dumps([asdict(one) for one in chosen], indent=2, ensure_ascii=False))
    elif name:
        for key, value in asdict(chosen[0]).items():
            print(f"{key:<20} {value}")
    else:
        for one in chosen:
            print(f"{one.name:<22} {one.title}")
    return 0
