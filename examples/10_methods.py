"""One figure, depth and light, carved by every method there is, as in Fig. 8 of the paper."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import hillshade, png8
from relieffab.picture.sheet import sheet
from relieffab.relief.names import NAMES


def run(folder: Path, width: int = 300) -> Path:
    """Carve a falcon by each method beside its shading; return the picture."""
    layers = rf.make_layers(
        rf.make_mesh(*rf.falcon(cell=90 / width), name="falcon"),
        rf.View(up="y"),
        size=(72.0, 108.0),
        resolution=(width, 3 * width // 2),
        margin=2.5,
    )
    ways = [rf.Carving(depth=2.5, method=name, wall_angle=90.0) for name in NAMES]
    images = [hillshade(rf.make_relief(layers, way)[0]).mean(axis=2) / 255 for way in ways]
    images.insert(0, layers.shading[0] + 0.5 * ~layers.mask)
    names = ["the model", *NAMES]
    rows = [sheet([images[k : k + 4]], [""], names[k : k + 4]) for k in (0, 4)]
    picture = folder / "10_methods.png"
    picture.write_bytes(png8(np.vstack(rows)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
