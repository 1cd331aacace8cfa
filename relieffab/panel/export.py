"""Panels as files: STL, 3MF, PLY and OBJ, written beside and then renamed."""

import os
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.sax.saxutils import quoteattr

import trimesh

from relieffab.errors import InputError, suggest
from relieffab.panel.model import Panel
from relieffab.panel.weld import weld

# 3MF Core Specification 1.3: the package's parts and their relationship.
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL_TYPE = "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"
RELATIONS_TYPE = "application/vnd.openxmlformats-package.relationships+xml"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
CONTENT_TYPES = (
    f'{XML}<Types xmlns="{PACKAGE}/content-types">'
    f'<Default Extension="rels" ContentType="{RELATIONS_TYPE}"/>'
    f'<Default Extension="model" ContentType="{MODEL_TYPE}"/></Types>'
)
RELATIONS = (
    f'{XML}<Relationships xmlns="{PACKAGE}/relationships">'
    '<Relationship Id="model" Target="/3D/3dmodel.model" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)


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


def _mesh(panel: Panel) -> trimesh.Trimesh:
    return trimesh.Trimesh(panel.vertices, panel.faces, process=False)


def write_stl(panel: Panel, path: Path) -> None:
    """Write a binary STL, mm, single precision as the format has it."""
    mesh = trimesh.Trimesh(*weld(panel.vertices, panel.faces), process=False)
    with beside(Path(path)) as part:
        mesh.export(part, file_type="stl")


def _model_xml(panel: Panel, name: str) -> str:
    """Describe one object in mm, 3MF Core Specification, chapters 3 and 4."""
    vertex = '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n' * len(panel.vertices)
    triangle = '<triangle v1="%d" v2="%d" v3="%d"/>\n' * len(panel.faces)
    return (
        f'{XML}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}">\n<resources>'
        f'<object id="1" type="model" name={quoteattr(name)}><mesh>\n<vertices>\n'
        f"{vertex % tuple(panel.vertices.ravel().tolist())}</vertices>\n<triangles>\n"
        f"{triangle % tuple(panel.faces.ravel().tolist())}</triangles>\n"
        '</mesh></object></resources>\n<build><item objectid="1"/></build>\n</model>\n'
    )


def write_3mf(panel: Panel, path: Path, *, name: str) -> None:
    """Write a 3MF package, mm; the same panel gives the same bytes.

    Parameters
    ----------
    panel : Panel
    path : Path
    name : str
        The object's name in the file.
    """
    parts = {
        "[Content_Types].xml": CONTENT_TYPES,
        "_rels/.rels": RELATIONS,
        "3D/3dmodel.model": _model_xml(panel, name),
    }
    with beside(Path(path)) as part, zipfile.ZipFile(part, "w") as package:
        for place, text in parts.items():
            entry = zipfile.ZipInfo(place)
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, text)


def write_panel(panel: Panel, path: Path, *, name: str = "panel") -> None:
    """Write a panel in the format its suffix names.

    Parameters
    ----------
    panel : Panel
    path : Path
        Ends in .stl, .3mf, .ply or .obj.
    name : str, optional
        The object's name, where the format has one.

    Raises
    ------
    InputError
        If the suffix is another, or the file cannot be written.
    """
    path = Path(path)
    kind = path.suffix.lower()
    if kind == ".3mf":
        write_3mf(panel, path, name=name)
    elif kind == ".stl":
        write_stl(panel, path)
    elif kind in {".ply", ".obj"}:
        with beside(path) as part:
            _mesh(panel).export(part, file_type=kind[1:])
    else:
        raise InputError(
            "unknown format of a panel",
            found=f"{path.suffix!r}",
            where=str(path),
            hint=suggest(kind, [".stl", ".3mf", ".ply", ".obj"]),
        )
