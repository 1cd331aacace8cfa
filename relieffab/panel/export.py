"""Panels as files: STL, 3MF, PLY, OBJ and GLB, written beside and then renamed."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from relieffab.errors import InputError, suggest
from relieffab.panel.formats import FORMATS
from relieffab.panel.meshes import to_binary, to_glb, to_metres, to_obj
from relieffab.panel.model import Panel
from relieffab.panel.threemf import to_3mf
from relieffab.panel.weld import weld


@contextmanager
def beside(path: Path) -> Iterator[Path]:
    """Lend a name in the same folder; on success it becomes `path`, else it goes.

    Raises
    ------
    InputError
        If the operating system refuses.
    """
    part = path.with_name(f".{path.stem}.{os.getpid()}.part{path.suffix}")
    try:
        yield part
        part.replace(path)
    except OSError as error:
        raise InputError(
            "the file cannot be written",
            expected="a folder that exists and may be written",
            found=error.strerror or str(error),
            where=str(path),
        ) from error
    finally:
        part.unlink(missing_ok=True)


def write_stl(panel: Panel, path: Path) -> None:
    """Write a binary STL, mm, single precision as the format has it."""
    with beside(Path(path)) as part:
        part.write_bytes(to_binary(*weld(panel.vertices, panel.faces), "stl"))


def write_3mf(panel: Panel, path: Path, *, name: str, picture: bytes | None = None) -> None:
    """Write a 3MF package, mm; the same panel gives the same bytes.

    Parameters
    ----------
    panel : Panel
    path : Path
    name : str
        The object's name in the file.
    picture : bytes, optional
        A PNG file for the package to show.
    """
    with beside(Path(path)) as part:
        part.write_bytes(to_3mf(*weld(panel.vertices, panel.faces), name, picture))


def write_glb(panel: Panel, path: Path, *, name: str) -> None:
    """Write a binary glTF, in metres and Y up as its specification has it."""
    with beside(Path(path)) as part:
        part.write_bytes(to_glb(*weld(to_metres(panel.vertices), panel.faces), name))


def write_panel(
    panel: Panel, path: Path, *, name: str = "panel", picture: bytes | None = None
) -> None:
    """Write a panel in the format its suffix names; every format holds single precision.

    Parameters
    ----------
    panel : Panel
    path : Path
        Ends in .stl, .3mf, .ply, .obj or .glb.
    name : str, optional
        The object's name, where the format has one.
    picture : bytes, optional
        A PNG file, where the format has room for one.

    Raises
    ------
    InputError
        If the suffix is another, or the file cannot be written.
    """
    path = Path(path)
    kind = path.suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        raise InputError(
            "unknown format of a panel",
            found=f"{path.suffix!r}",
            where=str(path),
            hint=suggest(f".{kind}", [f".{known}" for known in FORMATS]),
        )
    if kind == "3mf":
        write_3mf(panel, path, name=name, picture=picture)
    elif kind == "glb":
        write_glb(panel, path, name=name)
    else:
        mesh = weld(panel.vertices, panel.faces)
        with beside(path) as part:
            part.write_bytes(to_obj(*mesh, name) if kind == "obj" else to_binary(*mesh, kind))
