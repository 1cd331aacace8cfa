"""show: a picture or the page of any product."""

import json
import os
import sys
import tempfile
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import Json
from relieffab.errors import InputError

if TYPE_CHECKING:
    from relieffab.job.show.shown import Shown

KINDS = ("finding: ", "warning: ", "note: ")
"""What a job's notes begin with."""


def show(
    path: Annotated[Path, Parameter(help="a relief, solid, program, picture, or a job's folder")],
    /,
    *,
    output: Annotated[
        Path | None, Parameter(name=["--output", "-o"], help="picture to write, PNG")
    ] = None,
    light: Annotated[
        str,
        Parameter(
            help="degrees clockwise from the far side, and above the panel",
            allow_leading_hyphen=True,
        ),
    ] = "315,32.5",
    texture: Annotated[str, Parameter(help="stone or wood")] = "stone",
    cutter: Annotated[str | None, Parameter(help="of a program that does not tell its own")] = None,
    machine: Annotated[
        str | None, Parameter(help="of a program that does not tell its own")
    ] = None,
    as_json: Json = False,
) -> int:
    """Look at any product: a relief lit, a solid, what a program carves, a job's page."""
    from relieffab.job import readers
    from relieffab.job.show.lit import Lit
    from relieffab.job.show.show import show as shown_of

    lit = Lit(*readers.light(light), readers.texture(texture))
    _check(output)
    with console.progress_bar() as progress:
        shown = shown_of(path, lit, cutter=cutter, machine=machine, progress=progress)
    for note in shown.notes:
        console.message(note if note.startswith(KINDS) else f"note: {note}")
    seen = _write(shown, path, output)
    if as_json:
        print(json.dumps({"kind": shown.kind, **shown.facts, "shown": str(seen)}, indent=2))
    else:
        _tell(shown, path)
    if output is None and _screen():
        webbrowser.open(seen.resolve().as_uri())
    if not as_json:
        print(f"{'shown':<18}{seen}")
    return 0


def _check(output: Path | None) -> None:
    """Refuse a picture that could not be written, before any work is done."""
    if output is None:
        return
    if output.suffix.lower() != ".png":
        raise InputError("pictures are written as PNG", found=repr(output.suffix), where="output")
    if not output.parent.is_dir() or output.is_dir():
        raise InputError("the picture cannot be written there", where=str(output))


def _write(shown: "Shown", path: Path, output: Path | None) -> Path:
    """Write the picture where it is asked for, or beside all else that is temporary."""
    from relieffab.picture import png8

    if output is None and shown.page is not None:
        return shown.page
    if shown.image is None:
        raise InputError(
            "there is no picture to write of this", found=str(path), hint="without -o: it opens"
        )
    if output is None:
        output = Path(tempfile.mkdtemp(prefix="relieffab-")) / f"{path.stem}.png"
    part = output.with_name(f".{output.name}.part")
    part.write_bytes(png8(shown.image))
    part.replace(output)
    return output


def _tell(shown: "Shown", path: Path) -> None:
    print(f"{shown.kind:<18}{path}")
    for name, value in shown.facts.items():
        print(f"{_label(name):<18}{_words(name, value)}")


def _label(name: str) -> str:
    return name.removesuffix("_mm").replace("seconds", "time").replace("_", " ")


def _words(name: str, value: Any) -> str:
    """Write a fact for people."""
    from relieffab.job.sheet.words import clock, mm

    if name == "seconds":
        return clock(value)
    if isinstance(value, list):
        return _list(name, value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if name.endswith("_mm"):
        return f"{mm(value)} mm"
    if name.endswith("_share"):
        return f"{value:.1%}"
    return f"{value:,}" if isinstance(value, int) else str(value)


def _list(name: str, values: list[Any]) -> str:
    from relieffab.job.sheet.words import mm, span

    if name == "bounds_mm":
        axes = zip("XYZ", *values, strict=True)
        return ", ".join(f"{axis} {span(low, high)}" for axis, low, high in axes) + " mm"
    if name == "work_zero_mm":
        return ", ".join(f"{axis} {mm(at)}" for axis, at in zip("XYZ", values, strict=True)) + " mm"
    if all(isinstance(part, int | float) for part in values):
        return " x ".join(map(mm, values)) + (" mm" if name.endswith("_mm") else "")
    return ", ".join(map(str, values))


def _screen() -> bool:
    """Whether a picture would come before somebody's eyes."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
