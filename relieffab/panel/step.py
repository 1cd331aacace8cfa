"""STEP files read as triangles."""

from pathlib import Path

from relieffab.errors import InputError
from relieffab.panel.cad import cadquery, triangles
from relieffab.panel.model import Floats, Ints


def read_step(path: Path) -> tuple[Floats, Ints]:
    """Read the solids of a STEP file.

    Returns
    -------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int

    Raises
    ------
    InputError
        If it is missing, or no STEP file with a solid in it.
    CadUnavailableError
        If there is no cadquery to read it with.
    """
    if not path.is_file():
        raise InputError("there is no such STEP file", where=str(path))
    with path.open("rb") as file:
        start = file.read(12)
    # The CAD kernel tells of other files at length, on the terminal.
    if start != b"ISO-10303-21":
        raise InputError(
            "this is not a STEP file",
            expected="ISO-10303-21 at its start",
            found=repr(start)[2:-1],
            where=str(path),
        )
    cq = cadquery()
    try:
        found = cq.importers.importStep(str(path)).vals()
    except ValueError as fault:
        raise InputError(
            "the STEP file cannot be read", found=str(fault), where=str(path)
        ) from None
    if not found:
        raise InputError("the STEP file holds no solid", where=str(path))
    return triangles(cq.Workplane(obj=cq.Compound.makeCompound(found)))
