"""The marks that a chisel leaves: flat, gouge, point, claw, rasp, hatching, a pecked ground."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import relieffab as rf
from relieffab.picture import hillshade, png_small, smaller

STYLES = {
    "polished, the ground pecked": rf.Style(ground="pecked"),
    "flat": rf.Style("flat"),
    "gouge": rf.Style("gouge"),
    "point": rf.Style("point"),
    "claw": rf.Style("claw"),
    "rasp": rf.Style("rasp"),
    "hatch": rf.Style("hatch"),
    "gouge at 45 degrees, 1.6 mm": rf.Style("gouge", spacing=1.6, depth=0.25, direction=45.0),
}
DEPTH = 3.0  # mm, marks included
PITCH = 0.11  # mm: a finer picture is of a larger panel, with the same marks
LINE, GAP = 34, 10  # pixels


def tile(relief: rf.Relief, name: str) -> np.ndarray:
    """Light the body and one wing of the scarab; name the style."""
    image = hillshade(relief, light=(-1.0, 0.8, 0.8))
    left, right = (round(share * image.shape[1]) for share in (0.37, 0.97))
    page = Image.new("RGB", (right - left + GAP, image.shape[0] + LINE), "white")
    page.paste(Image.fromarray(image[:, left:right]), (GAP, LINE))
    letters = ImageFont.load_default(size=LINE * 0.65)
    ImageDraw.Draw(page).text((page.width / 2, LINE / 2), name, "black", letters, anchor="mm")
    return np.asarray(page)


def run(folder: Path, width: int = 1024) -> Path:
    """Carve the scarab once, and every style's marks into it; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    pixels = (width, 3 * width // 4)
    size = (width * PITCH, 0.75 * width * PITCH)
    layers = rf.make_layers(mesh, rf.View(up="y"), size=size, resolution=pixels, margin=4.0)
    room = max(style.headroom for style in STYLES.values())
    smooth, _ = rf.make_relief(layers, rf.Carving(depth=DEPTH - room))
    tiles = [
        tile(rf.carve_marks(smooth, layers, style, depth=DEPTH)[0], name)
        for name, style in STYLES.items()
    ]
    rows = [np.concatenate(tiles[k : k + 4], axis=1) for k in (0, 4)]
    picture = folder / "14_styles.png"
    picture.write_bytes(png_small(smaller(np.concatenate(rows), 1500)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
