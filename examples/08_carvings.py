"""Lines alone, a shallow and a deep relief of one figure, as in Fig. 6 of the paper."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import hillshade, png_small


def run(folder: Path, width: int = 460) -> Path:
    """Carve a falcon three ways and light them alike; return the picture."""
    mesh = rf.make_mesh(*rf.falcon(cell=90 / width), name="falcon")
    view, size = rf.View(up="y"), (80.0, 116.0)
    layers = rf.make_layers(mesh, view, size=size, resolution=(width, width * 29 // 20))
    ways = [
        rf.Carving(depth=1.0, line_depth=0.6, carve="lines"),
        rf.Carving(depth=1.0),
        rf.Carving(depth=4.0),
    ]
    images = [hillshade(rf.make_relief(layers, way)[0]) for way in ways]
    picture = folder / "08_carvings.png"
    picture.write_bytes(png_small(np.hstack(images)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
