"""Which way any product is shown: by what it is named, and what lies in it."""

from pathlib import Path

from relieffab.errors import InputError
from relieffab.job.folder import REPORT
from relieffab.job.show.carved import show_program
from relieffab.job.show.folder import show_folder, show_layers
from relieffab.job.show.height import show_relief
from relieffab.job.show.image import show_image
from relieffab.job.show.lit import Lit
from relieffab.job.show.shown import Shown
from relieffab.job.show.solid import STEP, show_solid
from relieffab.layers.mesh import USUAL_UP
from relieffab.progress import Progress, silent
from relieffab.relief.png import SIZE

PROGRAMS = (".nc", ".ngc", ".gcode", ".tap", ".cnc")
RELIEFS = (".tiff", ".tif")
PAGES = (".html", ".svg", ".pdf")
IMAGES = (".png", ".jpg", ".jpeg")


def show(
    path: Path,
    lit: Lit,
    *,
    cutter: str | None = None,
    machine: str | None = None,
    progress: Progress = silent,
) -> Shown:
    """Make something to look at of any product.

    Parameters
    ----------
    path : Path
        A relief, a mesh or CAD solid, a program, a picture, a drawing, layers, or the
        folder of a job.
    lit : Lit
    cutter, machine : str, optional
        Names of profiles, for a program that does not tell what it was made for.
    progress : Progress

    Raises
    ------
    InputError
        If it is none of those, or cannot be read.
    """
    if path.is_dir():
        return _folder(path)
    if not path.exists():
        raise InputError("there is no such file or folder", where=str(path))
    suffix = path.suffix.lower()
    if (cutter or machine) and suffix not in PROGRAMS:
        raise InputError("only programs have a cutter and a machine", where=str(path))
    if suffix in PROGRAMS:
        return show_program(path, lit, cutter=cutter, machine=machine, progress=progress)
    return _still(path, suffix, lit)


def _still(path: Path, suffix: str, lit: Lit) -> Shown:
    """Show what nothing has to be carved for."""
    if suffix in RELIEFS or (suffix == ".png" and _has_heights(path)):
        return show_relief(path, lit)
    if suffix in (*USUAL_UP, *STEP):
        return show_solid(path, lit)
    if suffix in IMAGES:
        return show_image(path)
    if suffix in PAGES:
        return Shown("page", {"bytes": path.stat().st_size}, page=path)
    if path.name == REPORT:
        return show_folder(path.parent)
    raise InputError(
        "this is nothing that can be shown",
        expected=" ".join((*RELIEFS, *IMAGES, *USUAL_UP, *STEP, *PROGRAMS, *PAGES)),
        found=repr(path.suffix),
        where=str(path),
    )


def _folder(folder: Path) -> Shown:
    if not (folder / REPORT).is_file() and (folder / "depth.png").is_file():
        return show_layers(folder)
    return show_folder(folder)


def _has_heights(path: Path) -> bool:
    """Whether a PNG says of itself that its greys are heights."""
    with path.open("rb") as file:
        return SIZE.encode() in file.read(4096)
