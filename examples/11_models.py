"""A range of models, each carved 3 mm deep, as in Fig. 9 of the paper; all made by code."""

import runpy
from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import hillshade, png_small

SIZE = (96.0, 105.0)


def run(folder: Path, width: int = 330) -> Path:
    """Carve six models into equal panels; return the picture."""
    cell = 100 / width
    shapes = [
        (rf.falcon(cell=cell), rf.View(up="y"), "stone"),
        (rf.lotus(cell=cell), rf.View(up="y"), "wood"),
        (rf.cat(cell=cell), rf.View(up="y"), "stone"),
        (rf.scarab(), rf.View(up="y"), "wood"),
        (_ammonite(), rf.View(up="y"), "stone"),
        (rf.cat(cell=cell), rf.View(azimuth=-40, elevation=8, up="y"), "wood"),
    ]
    images = []
    for shape, view, texture in shapes:
        layers = rf.make_layers(
            rf.make_mesh(*shape),
            view,
            size=SIZE,
            resolution=(width, width * 35 // 32),
        )
        relief, _ = rf.make_relief(layers, rf.Carving(depth=3.0))
        images.append(hillshade(relief, texture=texture))
    picture = folder / "11_models.png"
    picture.write_bytes(png_small(np.vstack([np.hstack(images[:3]), np.hstack(images[3:])])))
    return picture


def _ammonite() -> tuple:
    """Take the model of the example that shows how to make one."""
    return runpy.run_path(str(Path(__file__).with_name("04_own_model.py")))["ammonite"]()


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
