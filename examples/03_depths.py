"""One figure at 1, 2 and 4 mm: a shallower relief keeps the same drawing."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import hillshade, png8


def run(folder: Path, width: int = 512) -> Path:
    """Carve the scarab at three depths and light them alike; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    layers = rf.make_layers(mesh, rf.View(up="y"), resolution=(width, 3 * width // 4))
    reliefs = [rf.make_relief(layers, rf.Carving(depth=depth))[0] for depth in (1.0, 2.0, 4.0)]
    picture = folder / "03_depths.png"
    picture.write_bytes(png8(np.hstack([hillshade(relief) for relief in reliefs])))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
