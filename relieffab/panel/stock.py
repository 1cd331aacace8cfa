"""The uncut slab as a STEP file: the one place that knows cadquery.

cadquery takes three seconds to load and half a gigabyte to hold, so a job has
it do its work in a process of its own, beside everything else.
"""

import subprocess
import sys
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


def start_step(stock: Stock, path: Path) -> "subprocess.Popen[str]":
    """Begin `write_step` in a process of its own; `finish_step` waits for it."""
    sizes = [repr(size) for size in (stock.width, stock.height, stock.thickness)]
    command = [sys.executable, "-m", "relieffab.panel.stock", *sizes, str(path)]
    return subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)


def finish_step(process: "subprocess.Popen[str]") -> None:
    """Wait for a STEP file.

    Raises
    ------
    CadUnavailableError
        If it was not written, with what the process said last.
    """
    _, told = process.communicate()
    if process.returncode != 0:
        said = told.strip() or f"exit status {process.returncode}"
        raise CadUnavailableError(said if process.returncode == 2 else said.splitlines()[-1])


def _main(arguments: list[str]) -> int:
    width, height, thickness = (float(size) for size in arguments[:3])
    try:
        write_step(Stock(width, height, thickness), Path(arguments[3]))
    except RelieffabError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(_main(sys.argv[1:]))
