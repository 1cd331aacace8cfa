"""The scarab from model to panel: the picture at the top of the README."""

from pathlib import Path

import relieffab as rf
from relieffab.picture import png8


def run(folder: Path, width: int = 1024) -> Path:
    """Carve the scarab into a panel and picture it; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    layers = rf.make_layers(mesh, rf.View(up="y"), resolution=(width, 3 * width // 4))
    relief, _ = rf.make_relief(layers, rf.Carving(depth=3.0))
    panel = rf.make_panel(relief, rf.Stock(120, 90, 10))
    image, _ = rf.panel_picture(relief, panel, width=1000)
    picture = folder / "01_panel.png"
    picture.write_bytes(png8(image))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
