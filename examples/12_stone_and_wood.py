"""The carved look: a framed falcon in limestone, a lotus in wood, each under its own light."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import panel_picture, png_small


def carved(shape: tuple, size: tuple[float, float], width: int) -> rf.Relief:
    """Carve a model 4 mm deep."""
    layers = rf.make_layers(
        rf.make_mesh(*shape),
        rf.View(up="y"),
        size=size,
        resolution=(width, round(width * size[1] / size[0])),
        margin=14.0,
    )
    return rf.make_relief(layers, rf.Carving(depth=4.0))[0]


def run(folder: Path, width: int = 600) -> Path:
    """Make both panels and picture them; return the picture."""
    frame = rf.Frame(8.0, 2.5, rf.Edge("fillet", 1.2))
    falcon = carved(rf.falcon(cell=180 / width), (96.0, 128.0), width)
    lotus = carved(rf.lotus(cell=180 / width), (120.0, 120.0), width)
    panels = [
        (falcon, rf.Stock(96, 128, 14, shape="arched", frame=frame), (-1.0, 1.0, 0.8), "stone"),
        (lotus, rf.Stock(120, 120, 16, corner=4), (-1.0, 0.35, 0.75), "wood"),
    ]
    images = [
        panel_picture(
            relief, rf.make_panel(relief, stock), width=640, light=light, texture=texture
        )[0]
        for relief, stock, light, texture in panels
    ]
    picture = folder / "12_stone_and_wood.png"
    picture.write_bytes(png_small(np.hstack([image[: images[0].shape[0]] for image in images])))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
