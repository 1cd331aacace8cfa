"""Any triangles will do: an ammonite from a formula."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import hillshade, png8


def ammonite(turns: float = 3.4, steps: int = 4800, around: int = 96) -> tuple:
    """Sweep a ribbed, growing circle along a spiral; return vertices and faces."""
    # It begins far inside, where its middle is too narrow for a pixel.
    t = np.linspace(-8 * np.pi, 2 * np.pi * turns, steps)[:, None]
    a = np.linspace(0, 2 * np.pi, around, endpoint=False)[None, :]
    size = np.exp(0.175 * t)
    tube = 0.52 * size * (1 + 0.08 * np.abs(np.sin(9 * t + 0.8 * np.cos(a))))
    ring = size + tube * np.cos(a)
    points = np.stack([ring * np.cos(t), ring * np.sin(t), 1.1 * tube * np.sin(a)], axis=2)
    i, j = np.meshgrid(np.arange(steps - 1), np.arange(around), indexing="ij")
    k = (j + 1) % around
    n00, n01, n10, n11 = i * around + j, i * around + k, (i + 1) * around + j, (i + 1) * around + k
    sides = np.concatenate([np.stack([n00, n10, n11], -1), np.stack([n00, n11, n01], -1)])
    first, last = steps * around, steps * around + 1
    rim = np.arange(around)
    caps = [
        np.stack([np.full(around, first), rim, (rim + 1) % around], -1),
        np.stack(
            [np.full(around, last), first - around + (rim + 1) % around, first - 1 - rim[::-1]], -1
        ),
    ]
    vertices = np.concatenate(
        [points.reshape(-1, 3), points[0].mean(axis=0)[None], points[-1].mean(axis=0)[None]]
    )
    return vertices, np.concatenate([sides.reshape(-1, 3), *caps])


def run(folder: Path, width: int = 768) -> Path:
    """Carve the ammonite; return the picture."""
    mesh = rf.make_mesh(*ammonite(), name="ammonite")
    layers = rf.make_layers(
        mesh, rf.View(up="y"), size=(90.0, 90.0), resolution=(width, width), margin=5.0
    )
    relief, _ = rf.make_relief(layers, rf.Carving(depth=3.0))
    picture = folder / "04_own_model.png"
    picture.write_bytes(png8(hillshade(relief)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
