"""Machines, cutters and materials by name: TOML files read into frozen dataclasses."""

import tomllib
from collections.abc import Callable
from dataclasses import fields
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal, TypeVar

import platformdirs

from relieffab import units
from relieffab.cutter import Cutter
from relieffab.errors import InputError, suggest
from relieffab.machine import Machine, Material

Kind = Literal["machines", "cutters", "materials"]
Noun = TypeVar("Noun", Machine, Cutter, Material)

DEFAULT_MACHINE = "3018-prover"
DEFAULT_MATERIAL = "softwood"

_QUANTITIES: dict[str, Callable[[Any], float]] = {
    **dict.fromkeys(("diameter", "flute_length", "stepdown", "tip_diameter"), units.length),
    **dict.fromkeys(("corner_radius", "travel", "safe_height", "junction_deviation"), units.length),
    **dict.fromkeys(("shank_diameter", "stickout", "points"), units.length),
    **dict.fromkeys(("feed", "plunge", "max_rate"), units.feed),
    "angle": units.angle,
}


def machine(name: str = DEFAULT_MACHINE) -> Machine:
    """Read a machine's profile by its name."""
    return _read("machines", name, Machine)


def cutter(name: str) -> Cutter:
    """Read a cutter's profile by its name."""
    return _read("cutters", name, Cutter)


def material(name: str = DEFAULT_MATERIAL) -> Material:
    """Read a material's profile by its name."""
    return _read("materials", name, Material)


def names(kind: Kind) -> tuple[str, ...]:
    """List what can be asked for: 'machines', 'cutters' or 'materials'."""
    if kind not in ("machines", "cutters", "materials"):
        raise InputError(
            "unknown kind of profile",
            found=repr(kind),
            hint=suggest(str(kind), ("machines", "cutters", "materials")),
        )
    found = {path.stem for folder in _folders() for path in (folder / kind).glob("*.toml")}
    return tuple(sorted(found))


def user_folder() -> Path:
    """Return the folder whose profiles add to and override the shipped ones."""
    return Path(platformdirs.user_config_dir("relieffab")) / "machines"


def _folders() -> tuple[Path, ...]:
    """Return the folders to look in, the user's own first."""
    packaged = Path(str(files("relieffab"))) / "machines"
    beside = packaged.parent.parent / "machines"
    return user_folder(), packaged if packaged.is_dir() else beside


def _find(kind: Kind, name: str, folders: tuple[Path, ...], where: str) -> tuple[Path, int]:
    """Find a profile's file and the index of the folder it lies in."""
    for index, folder in enumerate(folders):
        path = folder / kind / f"{name}.toml"
        if path.parent == folder / kind and path.is_file():  # a name leads nowhere else
            return path, index
    raise InputError(f"no {kind[:-1]} {name!r}", where=where, hint=suggest(name, names(kind)))


def _read(kind: Kind, name: str, noun: type[Noun]) -> Noun:
    values, path = _inherit(kind, name)
    known = [field.name for field in fields(noun) if field.name != "name"]
    faults = [f"{key} ({suggest(key, known)})" for key in values if key not in known]
    if faults:
        raise InputError(
            f"the {kind[:-1]} {name} has unknown keys", found="; ".join(faults), where=str(path)
        )
    quantities = {key: _quantity(key, value, path, kind) for key, value in values.items()}
    return _validate(noun, {**quantities, "name": name}, path)


def _validate(noun: type[Noun], values: dict[str, Any], path: Path) -> Noun:
    """Build the noun; every fault is told with the key it belongs to."""
    from pydantic import TypeAdapter, ValidationError

    try:
        return TypeAdapter(noun).validate_python(values)
    except ValidationError as error:
        faults = [
            f"{'.'.join(str(part) for part in fault['loc'])}: {fault['msg']}"
            for fault in error.errors()
        ]
        raise InputError(
            f"the profile {path.stem} cannot be used", found="; ".join(faults), where=str(path)
        ) from error


def _inherit(kind: Kind, name: str) -> tuple[dict[str, Any], Path]:
    """Read a profile and lay it over those it inherits from.

    A profile may inherit from its own name: then the next folder's is meant.
    """
    folders = _folders()
    path, index = _find(kind, name, folders, f"{kind} profiles")
    first, seen = path, [path]
    values: dict[str, Any] = {}
    while True:
        found = _parse(path)
        parent = found.pop("inherits", None)
        values = {**found, **values}
        if parent is None:
            return values, first
        start = index + 1 if parent == path.stem else 0
        path, index = _find(kind, str(parent), folders[start:], f"inherits in {path}")
        index += start
        if path in seen:
            chain = " -> ".join(step.stem for step in [*seen, path])
            raise InputError("profiles inherit in a circle", found=chain, where=str(first))
        seen.append(path)


def _parse(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError("this is not TOML", found=str(error), where=str(path)) from error


def _quantity(key: str, value: Any, path: Path, kind: Kind) -> Any:
    """Turn text with a unit into a number; materials hold plain factors."""
    if kind == "materials" or key not in _QUANTITIES:
        return value
    if isinstance(value, list):
        return [_quantity(key, part, path, kind) for part in value]
    if not isinstance(value, str):
        return value
    try:
        return _QUANTITIES[key](value)
    except InputError as error:
        raise InputError(f"{key} cannot be read: {error}", where=str(path)) from error
