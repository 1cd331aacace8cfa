"""Few lines, some and many, and the relief that each gives, as in Fig. 7 of the paper."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import hillshade, png_small

DETAIL = (6.0, 1.8, 0.5)  # mm: finer forms give no lines


def run(folder: Path, width: int = 400) -> Path:
    """Draw and carve a scarab three times; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    columns = []
    for detail in DETAIL:
        layers = rf.make_layers(
            mesh,
            rf.View(up="y"),
            resolution=(width, 3 * width // 4),
            margin=3.0,
            drawing=rf.Drawing(detail=detail, min_length=1.0 + detail / 2, width=0.5),
        )
        drawing = (255 * (1 - layers.lines)).astype(np.uint8)
        relief, _ = rf.make_relief(layers, rf.Carving(depth=2.0, line_depth=0.35))
        columns.append(np.vstack([np.dstack([drawing] * 3), hillshade(relief)]))
    picture = folder / "09_density.png"
    picture.write_bytes(png_small(np.hstack(columns)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
