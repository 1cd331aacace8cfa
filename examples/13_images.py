"""Reliefs without a mesh: a depth map, a normal map, a photograph, a drawing, an SVG."""

from pathlib import Path

import numpy as np
from PIL import Image

import relieffab as rf
from relieffab.picture import hillshade, png8

ANKH = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 100">
<path d="M24 52 C0 28 12 2 30 2 C48 2 60 28 36 52 L58 47 V67 L36 62 L41 98 H19 L24 62 L2 67 V47 Z
         M30 14 C20 14 18 32 30 44 C42 32 40 14 30 14 Z" fill-rule="evenodd"/></svg>"""
SIZE = (120.0, 90.0)


def pictures(layers: rf.Layers) -> dict[str, np.ndarray]:
    """Take the pictures that others would come with, 8 bits each."""
    figure = layers.mask[..., None]
    depth = layers.depth[..., None]
    low, high = depth[figure].min(), depth[figure].max()
    light = np.array([-1.0, 1.0, 1.0]) / np.sqrt(3.0)
    grain = np.random.default_rng(0).normal(1.0, 0.03, (*layers.grid.shape, 1))
    lit = np.maximum(layers.normals @ light, 0.0)[..., None] * grain
    shown = {
        "depth": np.where(figure, 0.1 + 0.9 * (depth - low) / (high - low), 0.0),
        "normal": np.where(figure, (layers.normals + 1) / 2, [0.5, 0.5, 1.0]),
        "photo": np.where(figure, 0.05 + 0.9 * lit, 0.3) ** (1 / 2.2) * [1.0, 0.92, 0.8],
        "drawing": 1.0 - layers.lines[..., None],
    }
    return {kind: np.uint8(255 * np.clip(values, 0, 1)) for kind, values in shown.items()}


def saved(pixels: np.ndarray, path: Path) -> Path:
    """Write a picture, the photograph as a JPEG."""
    Image.fromarray(pixels.squeeze()).save(path, quality=85)
    return path


def run(folder: Path, width: int = 640) -> Path:
    """Carve the scarab from each picture of it, and an ankh from an SVG; return the picture."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    resolution = (width // 2, 3 * width // 8)
    grid = rf.Grid.on_panel(SIZE, resolution)
    shown = pictures(rf.make_layers(mesh, rf.View(up="y"), size=SIZE, resolution=resolution))
    columns = []
    for kind, pixels in shown.items():
        file = saved(pixels, folder / f"{kind}{'.jpg' if kind == 'photo' else '.png'}")
        picture = rf.read_picture(file)
        file.unlink()
        showing = rf.Showing(kind=kind, deep=14.0)
        layers = rf.layers_of_picture(picture, grid, SIZE, margin=6.0, showing=showing).layers
        carving = rf.Carving(depth=3.0, carve="lines" if layers.level else "all", line_depth=0.4)
        relief, _ = rf.make_relief(layers, carving)
        columns.append(np.concatenate([np.broadcast_to(pixels, (*pixels.shape[:2], 3)),
                                       hillshade(relief)]))  # fmt: skip
    (folder / "ankh.svg").write_text(ANKH)
    art = rf.read_svg(folder / "ankh.svg")
    (folder / "ankh.svg").unlink()
    layers = rf.layers_of_art(art, grid, rf.placed_on(art, SIZE, margin=6.0))
    relief, _ = rf.make_relief(layers, rf.Carving(depth=3.0, wall_angle=40.0))
    flat = np.uint8(255 * ~layers.mask)[..., None].repeat(3, axis=2)
    columns.append(np.concatenate([flat, hillshade(relief)]))
    target = folder / "13_images.png"
    target.write_bytes(png8(np.concatenate(columns, axis=1)))
    return target


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
