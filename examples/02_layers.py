"""What a relief is made from: depth, shading and line drawing of one view."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import png8


def run(folder: Path, width: int = 640) -> Path:
    """Draw the scarab's three layers side by side; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    layers = rf.make_layers(mesh, rf.View(up="y"), resolution=(width, 3 * width // 4))
    seen = layers.depth[layers.mask]
    depth = np.where(layers.mask, (layers.depth - seen.min()) / np.ptp(seen), 0)
    images = [depth, layers.shading.mean(axis=0), 1 - layers.lines]
    picture = folder / "02_layers.png"
    picture.write_bytes(png8((255 * np.hstack(images)).astype(np.uint8)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
