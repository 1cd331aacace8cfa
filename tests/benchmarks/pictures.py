"""What reliefs from pictures of a model share with the model's own relief.

    python tests/benchmarks/pictures.py [MODEL ...] [--view right]

Each model gives its depth map (float, 16 and 8 bits), its normal map, alone and with a
depth map beside it (exact, with noise of 1 % of the depth, blurred by 1.5 pixels), and
photographs of it under several lights, clean and with noise and JPEG's marks.  Of maps
the difference to the mesh's own relief is told, RMS and largest, percent of the depth,
without and with lines; of photographs the depth order, local and overall, beside that
of the mesh's own.
"""

import io
import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from tempfile import TemporaryDirectory

import numpy as np
from lines import models
from PIL import Image
from scipy import ndimage

from relieffab import Carving, Layers, Relief, make_layers, make_relief, named_view
from relieffab.errors import InputError
from relieffab.layers.image.make import Showing, layers_of_picture
from relieffab.layers.image.picture import Picture
from relieffab.layers.shading import lambert
from relieffab.layers.view import VIEWS
from relieffab.relief.model import nodes_of
from relieffab.relief.quality.order import order
from relieffab.relief.quality.pair import Pair

SIZE, RESOLUTION, MARGIN, DEPTH = (120.0, 90.0), (512, 384), 6.0, 3.0
LIGHTS = {
    "upper left": (-1.0, 1.0, 1.0),
    "above": (0.0, 1.0, 1.0),
    "right, low": (1.0, 0.2, 0.6),
    "front": (0.0, 0.0, 1.0),
}


def picture(values: np.ndarray, bits: int | None) -> Picture:
    """Store values as so many bits do."""
    top = 2**bits - 1 if bits else None
    kept = np.rint(values * top) / top if top else values
    return Picture(kept if kept.ndim == 3 else kept[..., None], None, bits, "PNG", "picture")


def maps(layers: Layers) -> Iterator[tuple[str, Picture, Showing]]:
    """Depth and normal maps of a view."""
    figure, seen = layers.mask, layers.depth[layers.mask]
    deep = float(np.ptp(seen))
    near = np.where(figure, 0.05 + 0.95 * (layers.depth - seen.min()) / deep, 0.0)
    for name, bits in (("depth, float", None), ("depth, 16 bits", 16), ("depth, 8 bits", 8)):
        yield name, picture(near, bits), Showing("depth", deep=deep)
    colours = np.where(figure[..., None], (layers.normals + 1) / 2, [0.5, 0.5, 1.0])
    yield "normals, 8 bits", picture(colours, 8), Showing("normal")
    grain = np.random.default_rng(0).normal(0.0, 0.01, near.shape)
    with TemporaryDirectory() as folder:
        path = f"{folder}/depth.png"
        for name, beside, bits in (
            ("depth of 16 bits", near, 16),
            ("depth of 8 bits", near, 8),
            ("grainy depth", np.where(figure, np.clip(near + grain, 0.0, 1.0), 0.0), 8),
            ("blurred depth", ndimage.gaussian_filter(near, 1.5), 8),
        ):
            kind = np.uint16 if bits == 16 else np.uint8
            Image.fromarray(np.rint(beside * (2**bits - 1)).astype(kind)).save(path)
            yield f"normals, {name}", picture(colours, 8), Showing("normal", depth_map=path)


def photographs(layers: Layers) -> Iterator[tuple[str, Picture]]:
    """Renders in sRGB, 8 bits, on grey; then one with noise, as a JPEG."""
    rng = np.random.default_rng(0)
    for name, way in LIGHTS.items():
        unit = np.array(way) / np.linalg.norm(way)
        lit = 0.05 + 0.9 * lambert(layers.normals, unit[None])[0]
        yield name, picture(np.where(layers.mask, lit, 0.3) ** (1 / 2.2), 8)
        if name == "upper left":
            noisy = lit * rng.normal(1.0, 0.06, lit.shape)
            grey = np.clip(np.where(layers.mask, noisy, 0.3), 0, 1) ** (1 / 2.2)
            file = io.BytesIO()
            Image.fromarray(np.uint8(255 * grey)).save(file, "JPEG", quality=75)
            pixels = np.asarray(Image.open(file)) / 255
            yield f"{name}, grainy JPEG", Picture(pixels[..., None], None, 8, "JPEG", name)


def carved(layers: Layers, carve: str) -> Relief:
    """Carve as usual."""
    return make_relief(layers, Carving(depth=DEPTH, carve=carve))[0]


def compare(layers: Layers) -> None:
    """Print a row for each picture."""
    own = {carve: carved(layers, carve) for carve in ("surface", "all")}
    figure = nodes_of(layers.mask)
    for name, shown, showing in maps(layers):
        found = layers_of_picture(shown, layers.grid, SIZE, margin=MARGIN, showing=showing).layers
        cells = []
        for carve, relief in own.items():
            off = (carved(found, carve).heights - relief.heights)[figure] / DEPTH * 100
            cells.append(f"{carve}: {np.sqrt((off**2).mean()):5.2f} % {np.abs(off).max():6.2f} %")
        print(f"  {name:28}" + "   ".join(cells), flush=True)
    kept = order(Pair(own["surface"], layers))
    print(f"  {'order of the mesh itself':28}local {kept.local:.3f}   overall {kept.overall:.3f}")
    for name, shown in photographs(layers):
        seen = layers_of_picture(shown, layers.grid, SIZE, margin=MARGIN, showing=Showing("photo"))
        missed = (seen.layers.mask != layers.mask).sum() / layers.mask.sum()
        kept = order(Pair(carved(seen.layers, "surface"), layers))
        print(
            f"  {'light: ' + name:28}local {kept.local:.3f}   overall {kept.overall:.3f}   "
            f"light fits {seen.facts['light_fit']:.2f}   mask off {100 * missed:.1f} %",
            flush=True,
        )


def main() -> None:
    """Print a table of every model."""
    parser = ArgumentParser(description="Reliefs from pictures beside those from meshes.")
    parser.add_argument("models", nargs="*", metavar="MODEL", help="two built-in ones if none")
    parser.add_argument("--view", choices=VIEWS, default="front")
    asked = parser.parse_args()
    try:
        for mesh, up in models(asked.models):
            print(f"{mesh.name}, {asked.view}, {RESOLUTION[0]} x {RESOLUTION[1]}: RMS, largest")
            view = named_view(asked.view, up)
            compare(make_layers(mesh, view, size=SIZE, resolution=RESOLUTION, margin=MARGIN))
    except InputError as fault:
        sys.exit(str(fault))


if __name__ == "__main__":
    main()
