"""Sheet: a picture or an SVG that a person has opened, light enough to be tried."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.art.art import Art, Mark, Ring
from relieffab.layers.art.make import layers_of_art
from relieffab.layers.image.figure import opaque
from relieffab.layers.image.kind import check_shown, kind_of
from relieffab.layers.image.picture import Picture

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

TRIED, SHOWN = 2048, 1024
"""Pixels of the longer side at most, of what previews are made from and of what the page shows."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """A picture or an SVG that was read.

    Parameters
    ----------
    file : Path
        Whole, for the job.
    flat : Picture or Art
        A picture in no more pixels than previews can show.
    kind : str
        What a picture shows by the values of the whole; 'svg' of an SVG.
    shape : tuple of int
        Rows and columns of the whole picture; 0 of an SVG.
    shown : (rows, cols, 4) ndarray
        Its colours and opacity, 0 to 255.
    box : tuple of float
        Left, top, right and bottom of `shown`, in the pixels or units of `flat`.
    """

    file: Path
    flat: Picture | Art
    kind: str
    shape: tuple[int, int]
    shown: Bytes
    box: tuple[float, float, float, float]

    @property
    def name(self) -> str:
        """Of its file."""
        return self.file.name

    @property
    def notes(self) -> tuple[str, ...]:
        """What was done to read it."""
        return self.flat.notes

    @property
    def about(self) -> str:
        """What it is, in a few words."""
        if isinstance(self.flat, Art):
            return f"SVG, {len(self.flat.marks)} marks"
        bits = f"{self.flat.bits} bits" if self.flat.bits else "floating point"
        return f"{self.flat.format}, {self.shape[1]} x {self.shape[0]} pixels, {bits}"


def sheet_of_picture(picture: Picture, file: Path) -> Sheet:
    """Make the lighter copies of a picture.

    Raises
    ------
    InputError
        If it shows nothing.
    """
    check_shown(picture)
    kind, flat = kind_of(picture), lighter(picture, TRIED)
    rows, cols = flat.shape
    # Places of a picture are those of its pixels' centres.
    box = (-0.5, -0.5, cols - 0.5, rows - 0.5)
    return Sheet(file, flat, kind, picture.shape, _colours(lighter(flat, SHOWN)), box)


def lighter(picture: Picture, most: int) -> Picture:
    """Average blocks of pixels until the longer side has no more than so many.

    What is transparent or no number does not count; a block of one value keeps it.
    """
    block = -(-max(picture.shape) // most)
    if block == 1:
        return picture
    seen = opaque(picture)
    count = _sums(seen.astype(float), block)
    values = np.full((*count.shape, picture.values.shape[2]), np.nan)
    for k in range(values.shape[2]):
        channel = np.where(seen, picture.values[..., k], 0.0)
        total = _sums(channel, block)
        np.divide(total, count, out=values[..., k], where=count > 0)
    alpha = None if picture.alpha is None else _sums(picture.alpha, block) / block**2
    if alpha is not None:
        values[count == 0] = 0.0
    return Picture(values, alpha, picture.bits, picture.format, picture.name, picture.notes)


def _sums(image: Floats, block: int) -> Floats:
    """Sum blocks, the last of each row and column filled up with what is at the edge."""
    rows, cols = (-(-n // block) * block for n in image.shape)
    wide = np.pad(image, ((0, rows - image.shape[0]), (0, cols - image.shape[1])), mode="edge")
    split = wide.reshape(rows // block, block, cols // block, block)
    return split.sum(axis=(1, 3))  # type: ignore[no-any-return]


def _colours(picture: Picture) -> Bytes:
    """Give a picture's colours and opacity; floating point from its least to its largest value."""
    seen = opaque(picture)
    values = np.where(seen[..., None], picture.values, 0.0)
    if picture.bits is None:
        low, high = values[seen].min(), values[seen].max()
        values = (values - low) / max(high - low, 1e-12)
    alpha = seen if picture.alpha is None else seen * picture.alpha
    rgba = np.concatenate([np.broadcast_to(values, (*seen.shape, 3)), alpha[..., None]], axis=2)
    return np.rint(255 * np.clip(rgba, 0.0, 1.0)).astype(np.uint8)


def sheet_of_art(art: Art, file: Path) -> Sheet:
    """Make a picture of art: its ink on nothing."""
    x0, y0, x1, y1 = art.bounds
    pitch = max(x1 - x0, y1 - y0, 1e-9) / (SHOWN - 2)
    cols, rows = (int(np.ceil(side / pitch)) + 2 for side in (x1 - x0, y1 - y0))
    left, top = x0 - pitch, y0 - pitch
    grid = Grid(rows, cols, 1.0, (0.0, float(rows)))
    scale = 1.0 / pitch
    matrix = [[scale, 0.0, -scale * left], [0.0, -scale, rows + scale * top], [0.0, 0.0, 1.0]]
    layers = layers_of_art(art, grid, matrix)
    rgba = np.zeros((rows, cols, 4), np.uint8)
    ink = np.maximum(layers.lines, layers.mask if art.filled else 0.0)
    rgba[..., 3] = np.rint(255 * ink)
    return Sheet(
        file, art, "svg", (0, 0), rgba, (left, top, left + cols * pitch, top + rows * pitch)
    )


def save(sheet: Sheet, folder: Path) -> None:
    """Write a sheet for `load`: no pickles, which would run what a stranger wrote."""
    arrays, told = _taken_apart(sheet.flat)
    facts = {"kind": sheet.kind, "shape": sheet.shape, "box": sheet.box, **told}
    for name, array in {"shown": sheet.shown, **arrays}.items():
        np.save(folder / f"{name}.npy", array, allow_pickle=False)
    (folder / "sheet.json").write_text(json.dumps(facts), encoding="utf-8")


def load(folder: Path, file: Path) -> Sheet:
    """Read what `save` wrote; of a file it is told where that is now."""
    told = json.loads((folder / "sheet.json").read_text(encoding="utf-8"))
    arrays = {path.stem: np.load(path, allow_pickle=False) for path in folder.glob("*.npy")}
    flat = (_art if told["kind"] == "svg" else _picture)(told, arrays, file.name)
    shape = (told["shape"][0], told["shape"][1])
    return Sheet(file, flat, told["kind"], shape, arrays["shown"], tuple(told["box"]))


def _taken_apart(flat: Picture | Art) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
    if isinstance(flat, Picture):
        alpha = {} if flat.alpha is None else {"alpha": flat.alpha}
        told = {"bits": flat.bits, "format": flat.format, "notes": flat.notes}
        return {"values": flat.values, **alpha}, told
    rings = [ring for mark in flat.marks for ring in mark.rings]
    marks = [
        {
            "closed": [ring.closed for ring in mark.rings],
            "fill": mark.fill,
            "paper": mark.paper,
            "width": mark.width,
        }
        for mark in flat.marks
    ]
    arrays = {
        "points": np.concatenate([ring.points for ring in rings]),
        "lengths": np.array([len(ring.points) for ring in rings]),
    }
    return arrays, {"marks": marks, "page": flat.page, "notes": flat.notes}


def _picture(told: dict[str, Any], arrays: dict[str, NDArray[Any]], name: str) -> Picture:
    values, alpha = arrays["values"], arrays.get("alpha")
    return Picture(values, alpha, told["bits"], told["format"], name, tuple(told["notes"]))


def _art(told: dict[str, Any], arrays: dict[str, NDArray[Any]], name: str) -> Art:
    ends = np.cumsum(arrays["lengths"])[:-1]
    points = iter(np.split(arrays["points"], ends))
    marks = tuple(
        Mark(
            tuple(Ring(next(points), closed) for closed in mark["closed"]),
            mark["fill"],
            mark["paper"],
            mark["width"],
        )
        for mark in told["marks"]
    )
    page = told["page"] and (told["page"][0], told["page"][1])
    return Art(marks, page, name, "svg", tuple(told["notes"]))
