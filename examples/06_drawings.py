"""Line drawings: three views, three amounts of detail, other kinds of line.

Without arguments it draws the scarab; `python 06_drawings.py MODEL ...` draws
models of yours, a row each, into drawings.png.
"""

import sys
from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import png8

SIZE = (90.0, 68.0)
GOLD = (190, 130, 20)


def tile(mesh: rf.Mesh, view: rf.View, width: int, **drawing) -> np.ndarray:
    """Draw one view; highlights in gold."""
    layers = rf.make_layers(
        mesh,
        view,
        size=SIZE,
        margin=3.0,
        resolution=(width, width * 3 // 4),
        drawing=rf.Drawing(width=0.35, secondary=0.75, **drawing),
    )
    light = rf.line_image((s for s in layers.strokes if s.light), layers.grid, width=0.35)
    paper = np.full((*layers.grid.shape, 3), 255.0)
    paper += light[..., None] * (np.array(GOLD) - paper)
    return (paper * (1 - layers.lines[..., None])).astype(np.uint8)


def sheet(rows: list[list[np.ndarray]]) -> bytes:
    """Lay tiles out in rows."""
    return png8(np.vstack([np.hstack(row) for row in rows]))


def three_views(mesh: rf.Mesh, width: int, up: str) -> list[np.ndarray]:
    """Draw a model from the front, from three quarters and from above, near by."""
    views = [rf.View(0, 0, up=up), rf.View(55, 12, up=up), rf.View(25, 45, up=up, perspective=50)]
    return [tile(mesh, view, width) for view in views]


def run(folder: Path, width: int = 480) -> Path:
    """Draw the scarab nine times; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    view, usual = rf.View(up="y"), ("outline", "contour", "crease", "suggestive")
    rows = [
        three_views(mesh, width, "y"),
        [tile(mesh, view, width, detail=detail, min_length=1.5) for detail in (0.6, 1.8, 5.0)],
        [
            tile(mesh, view, width, kinds=(*usual[:3], "apparent-ridge")),
            tile(mesh, view, width, kinds=(*usual[:3], "ridge", "valley")),
            tile(mesh, view, width, kinds=(*usual, "suggestive-highlight")),
        ],
    ]
    picture = folder / "06_drawings.png"
    picture.write_bytes(sheet(rows))
    return picture


if __name__ == "__main__":
    here = Path(__file__).parent / "pictures"
    if sys.argv[1:]:
        meshes = [rf.read_mesh(path) for path in sys.argv[1:]]
        here /= "drawings.png"
        here.write_bytes(sheet([three_views(m, 480, rf.guess_up(m)) for m in meshes]))
        print(here)
    else:
        print(run(here))
