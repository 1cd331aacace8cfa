"""The uncut slab as a STEP file: the one place that knows cadquery."""

from pathlib import Path
from types import ModuleType

from relieffab.errors import RelieffabError
from relieffab.panel.export import beside
from relieffab.stock import Stock


class CadUnavailableError(RelieffabError):
    """The CAD library cannot be loaded here; all else works without it."""


def _cadquery() -> ModuleType:
    """Load cadquery, which takes seconds and asks for the system's OpenGL."""
    try:
        import cadquery
    except ImportError as error:
        missing = isinstance(error, ModuleNotFoundError) and error.name == "cadquery"
        raise CadUnavailableError(
            "the STEP file cannot be written without cadquery",
            found=str(error),
            hint="pip install cadquery" if missing else "apt install libgl1 libx11-6",
        ) from error
    return cadquery  # type: ignore[no-any-return]


def write_step(stock: Stock, path: Path) -> None:
    """Write the slab before anything is cut as a STEP file, mm, its face at Z0.

    Parameters
    ----------
    stock : Stock
    path : Path
        Ends in .step or .stp.

    Raises
    ------
    CadUnavailableError
        If cadquery, or a system library it needs, is not there.
    InputError
        If the file cannot be written.
    """
    cadquery = _cadquery()
    box = cadquery.Workplane("XY").box(
        stock.width, stock.height, stock.thickness, centered=(False, False, False)
    )
    box = box.translate((0.0, 0.0, -stock.thickness))
    with beside(Path(path)) as part:
        cadquery.exporters.export(box, str(part), exportType="STEP")
