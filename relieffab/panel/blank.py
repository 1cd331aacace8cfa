"""The uncut stock as triangles, and its STEP files from a process beside the job's own."""

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from relieffab.errors import InputError, RelieffabError
from relieffab.panel import cad
from relieffab.panel.formats import FRAME, STOCK
from relieffab.panel.model import Floats, Ints
from relieffab.round import Curved, Round
from relieffab.stock import Stock

BLANK = "blank.npz"

AnyStock = Stock | Round | Curved


@dataclass(frozen=True, eq=False)
class Blank:
    """The stock's surface.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm, the face at Z0.
    faces : (f, 3) ndarray of int
        Counter-clockwise seen from outside.
    """

    vertices: Floats
    faces: Ints


def _box(stock: Stock) -> Blank:
    corners = np.array(list(np.ndindex(2, 2, 2)), float) - [0.0, 0.0, 1.0]
    fans = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [half for a, b, c, d in fans for half in ((a, b, c), (a, c, d))]
    return Blank(corners * [stock.width, stock.height, stock.thickness], np.array(faces))


def make_blank(stock: Stock) -> Blank:
    """Cover the stock with triangles; only one with a shape takes cadquery.

    Raises
    ------
    CadUnavailableError
        If it is not there.
    InputError
        If the CAD kernel cannot break the frame's edge.
    """
    if stock.plain:
        return _box(stock)
    return Blank(*cad.triangles(cad.stock_solid(stock, cad.frame_solid(stock))))


def write_steps(stock: AnyStock, folder: Path) -> None:
    """Write stock.step, frame.step where there is one, and a shaped slab's blank.npz.

    Raises
    ------
    CadUnavailableError
        If cadquery is not there.
    InputError
        If a file cannot be written, or the kernel cannot break the frame's edge.
    """
    if not isinstance(stock, Stock):
        cad.write_step(cad.bent_solid(stock), folder / STOCK)
        return
    frame = cad.frame_solid(stock)
    solid = cad.stock_solid(stock, frame)
    cad.write_step(solid, folder / STOCK)
    if frame is not None:
        cad.write_step(frame, folder / FRAME)
    if not stock.plain:
        vertices, faces = cad.triangles(solid)
        np.savez(folder / BLANK, vertices=vertices, faces=faces)


class Drafting:
    """`write_steps` at work in a process of its own.

    Parameters
    ----------
    stock : Stock, Round or Curved
    folder : Path
        Where its files go.
    """

    def __init__(self, stock: AnyStock, folder: Path) -> None:
        told = [type(stock).__name__, json.dumps(asdict(stock)), str(folder)]
        command = [sys.executable, "-m", __name__, *told]
        self.stock, self.folder = stock, folder
        self._process = subprocess.Popen(
            command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True
        )
        self._said: str | None = None

    def finish(self) -> None:
        """Wait for the files; again, it is no more than a look.

        Raises
        ------
        CadUnavailableError
            If cadquery is not there, or failed; with what the process said last.
        InputError
            If the stock cannot be drawn.
        """
        if self._said is None:
            self._said = self._process.communicate()[1].strip()
        status, said = self._process.returncode, self._said
        if status == InputError.exit_status:
            raise InputError(said)
        if status != 0:
            last = said.splitlines()[-1:] or [f"exit status {status}"]
            raise cad.CadUnavailableError(said if status == UNAVAILABLE else last[0])

    def blank(self) -> Blank:
        """Take a slab's surface; of a shaped one, from the file it left."""
        if isinstance(self.stock, Stock) and self.stock.plain:
            return _box(self.stock)
        self.finish()
        with np.load(self.folder / BLANK) as held:
            return Blank(held["vertices"], held["faces"])

    def stop(self) -> None:
        """End the process if it still runs, and take away what is not of a job."""
        self._process.kill()
        self._process.wait()
        if self._process.stderr:
            self._process.stderr.close()
        (self.folder / BLANK).unlink(missing_ok=True)


@contextmanager
def drafting(stock: AnyStock, folder: Path) -> Iterator[Drafting]:
    """Draw a stock beside all that is done meanwhile."""
    work = Drafting(stock, folder)
    try:
        yield work
    finally:
        work.stop()


UNAVAILABLE = 4  # exit status where the CAD library is not there


def _stock(kind: str, values: dict[str, Any]) -> AnyStock:
    if kind == "Round":
        return Round(**values)
    return Curved(**values) if kind == "Curved" else Stock.of(values)


def _main(arguments: list[str]) -> int:
    kind, values, folder = arguments
    try:
        write_steps(_stock(kind, json.loads(values)), Path(folder))
    except RelieffabError as error:
        sys.stderr.write(f"{error}\n")
        missing = isinstance(error, cad.CadUnavailableError)
        return UNAVAILABLE if missing else error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(_main(sys.argv[1:]))
