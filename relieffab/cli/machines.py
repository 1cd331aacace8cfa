"""machines: the profiles, and one made from a machine's own settings."""

import json
import sys
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import App, Parameter

from relieffab.cli import console
from relieffab.cli.options import Json, Overwrite
from relieffab.errors import InputError

machines = App(name="machines", help="List machines, cutters or materials, or print one.")


@machines.default
def listing(
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


@machines.command(name="import-grbl")
def import_grbl(
    dump: Annotated[
        str,
        Parameter(
            help="file with the answer to $$, or - for what is piped in", allow_leading_hyphen=True
        ),
    ],
    /,
    *,
    name: Annotated[str, Parameter(help="of the profile, as --machine will ask for it")],
    title: Annotated[str | None, Parameter(help="for people; the name if not given")] = None,
    overwrite: Overwrite = False,
) -> int:
    """Make a profile of your own from a machine's $$ dump."""
    from relieffab import profiles
    from relieffab.grbl.profile import read_dump, to_toml

    if not name.replace("-", "").replace(".", "").replace("_", "").isalnum():
        raise InputError(
            "this cannot be the name of a profile",
            expected="letters, digits, - . _",
            found=repr(name),
        )
    text = sys.stdin.read() if dump == "-" else _text(Path(dump))
    profile = to_toml(read_dump(text.splitlines()), title or name)
    path = profiles.user_folder() / "machines" / f"{name}.toml"
    if path.exists() and not overwrite:
        raise InputError(
            "the profile is already there", where=str(path), hint="another name, or --overwrite"
        )
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_suffix(".part")
    beside.write_text(profile, encoding="utf-8")
    beside.replace(path)
    made = profiles.machine(name)
    console.message(f"note: set spindle to the true rpm in {path} if $30 is not")
    print(f"{made.name:<22} {made.title}")
    return 0


def _text(path: Path) -> str:
    if not path.is_file():
        raise InputError("there is no such file", where=str(path))
    return path.read_text(encoding="latin-1")
