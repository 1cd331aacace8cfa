"""The job's pictures as data URIs, small enough for one page."""

import io
from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from PIL import Image

WIDEST, NARROW = 1200, 480  # pixels
INK, DENSEST = (60, 44, 28), 0.8


class Picture(NamedTuple):
    """A picture on the page.

    Parameters
    ----------
    name : str
        What it shows, for the page's own use.
    uri : str
    words : str
        What it shows, for people.
    """

    name: str
    uri: str
    words: str


def _listed(report: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Name the pictures that a report lists: kind, file, words."""
    if "picture" in report:
        how = "in perspective" if report["picture"]["method"] == "pyrender" else "seen straight on"
        yield "preview", report["picture"]["file"], f"What will be carved, {how}"
    if "view" in report:
        yield "depth", "layers/depth.png", "Depth: near is white"
        yield "lambert", "layers/lambert.png", "Shading"
        yield "lines", "layers/lines.png", "Line drawing"
    for kind, file in report.get("verification", {}).get("pictures", {}).items():
        yield kind, file, _PROOF[kind]
    for solid in ("plaque", "mould"):
        if picture := report.get(solid, {}).get("picture"):
            yield solid, picture["file"], f"The {solid}"
    if "relief" in report:
        yield "plan", "relief.png", ""


_PROOF = {
    "look": "The relief wanted, and as the programs leave it",
    "deviation": "What stands above the relief, or is cut below it",
}


def pictures(report: Mapping[str, Any], folders: Sequence[Path]) -> dict[str, Picture]:
    """Find a job's pictures and embed them.

    Parameters
    ----------
    report : mapping
        What report.json holds.
    folders : sequence of Path
        Where they may lie; the first that has one gives it.

    Returns
    -------
    dict of Picture
        Those that are there: preview, depth, lambert, lines, look, deviation, plaque, mould;
        `plan` is the height field, small, for the drawing of the stock.
    """
    found = {}
    for name, file, words in _listed(report):
        path = next((folder / file for folder in folders if (folder / file).is_file()), None)
        if path is not None:
            found[name] = Picture(name, _uri(path, name), words)
    return found


def _uri(path: Path, name: str) -> str:
    width = NARROW if name in ("depth", "lambert", "lines", "plan") else WIDEST
    image = _eight_bits(Image.open(path))
    image.thumbnail((width, width), Image.Resampling.LANCZOS)
    # Few, flat colours and sharp edges keep better and smaller as PNG.
    kind = "PNG" if name in ("deviation", "lines", "plan") else "JPEG"
    if name == "deviation":
        image = image.quantize(128, dither=Image.Dither.NONE)
    if name == "plan":
        image = _ink(image)
    buffer = io.BytesIO()
    image.save(buffer, format=kind, quality=85, optimize=True)
    return f"data:image/{kind.lower()};base64,{b64encode(buffer.getvalue()).decode()}"


def _eight_bits(image: Image.Image) -> Image.Image:
    if image.mode.startswith("I"):
        return Image.fromarray((np.asarray(image).astype(np.uint32) >> 8).astype(np.uint8))
    return image.convert("L" if image.mode in ("1", "L") else "RGB")


def _ink(heights: Image.Image) -> Image.Image:
    """Draw heights in ink that is denser where they are lower, and none on the face."""
    page = Image.new("RGBA", heights.size, INK)
    page.putalpha(Image.eval(heights, lambda grey: round(DENSEST * (255 - grey))))
    return page
