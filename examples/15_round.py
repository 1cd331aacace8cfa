"""A frieze of scarabs and flutes all round a column, and a ring with a guilloche."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.grid import Grid
from relieffab.picture import png8

DIAMETER, LENGTH, SCARABS, HIGH = 80.0, 130.0, 3, 66.0
FLUTES, FLUTE_DEPTH = 24, 1.4
RING, BORE, RING_LENGTH, WAVES = 40.0, 33.0, 20.0, 7
STRAND, SWING, RING_DEPTH = 2.3, 4.2, 1.3


def frieze(pixels: int) -> rf.Relief:
    """Lay scarabs side by side, once round the column, and flutes below them."""
    around = np.pi * DIAMETER
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    wide = around / SCARABS
    view, size = rf.View(up="y"), (wide, HIGH)
    layers = rf.make_layers(mesh, view, size=size, resolution=(pixels, pixels), margin=4.0)
    scarab = rf.make_relief(layers, rf.Carving(depth=2.5))[0]
    top = LENGTH - HIGH - 6
    places = [rf.Placed(scarab, (k * wide, top), "scarab") for k in range(SCARABS)]
    laid = rf.compose(places, (around, LENGTH))
    x, y = laid.grid.node_axes()
    every, half, reach = around / FLUTES, 0.4 * around / FLUTES, top / 2 - 6
    across = np.abs((x % every) - every / 2)[None, :]
    along = np.maximum(np.abs(y - top / 2) - reach + half, 0.0)[:, None]
    flutes = -FLUTE_DEPTH * np.clip(1 - (across**2 + along**2) / half**2, 0, 1)
    return relief_of(laid.grid, np.minimum(laid.heights, flutes), laid.depth)


def guilloche(pixels: int) -> rf.Relief:
    """Twist two strands round the ring, each over and under the other, between two rails."""
    around = np.pi * RING
    pitch = around / pixels
    rows = int(RING_LENGTH / pitch)
    grid = Grid(rows, pixels, pitch, (0.0, rows * pitch + (RING_LENGTH - rows * pitch) / 2))
    x, y = grid.node_axes()
    turn = 2 * np.pi * WAVES * x[None, :] / around
    height = y[:, None] - RING_LENGTH / 2
    strands = []
    for phase in (0.0, np.pi):
        wave = turn + phase
        slope = SWING * np.cos(wave) * 2 * np.pi * WAVES / around
        away = (height - SWING * np.sin(wave)) / np.hypot(1, slope)
        under = 0.4 * (1 + np.cos(wave + turn / 2))
        rounded = RING_DEPTH * np.sqrt(np.clip(1 - (away / STRAND) ** 2, 0, None))
        strands.append(rounded - np.where(np.abs(away) < STRAND, under * RING_DEPTH, 0.0))
    heights = np.maximum(*strands) - RING_DEPTH
    rails = np.abs(height) > SWING + STRAND + 0.4
    return relief_of(grid, np.where(rails, 0.0, np.clip(heights, -RING_DEPTH, 0.0)), RING_DEPTH)


def relief_of(grid: Grid, heights: np.ndarray, depth: float) -> rf.Relief:
    """Make heights a relief whose edges meet exactly; what is sunk is its figure."""
    heights = np.c_[heights[:, :-1], heights[:, :1]]
    low = heights < 0
    mask = low[1:, 1:] | low[1:, :-1] | low[:-1, 1:] | low[:-1, :-1]
    return rf.Relief(grid, heights, mask, depth)


def run(folder: Path, width: int = 1536) -> Path:
    """Carve both; return the picture of them."""
    pixels = max(width // 4, 96)
    column = rf.make_round(frieze(pixels), rf.Round(np.pi * DIAMETER, LENGTH, DIAMETER))
    ring = rf.make_round(guilloche(pixels * 2), rf.Round(np.pi * RING, RING_LENGTH, RING, BORE))
    images = [
        rf.standing_picture(column, width=width * 5 // 8, turns=(0.0, 60.0)),
        rf.standing_picture(ring, width=width * 3 // 8, turns=(0.0,)),
    ]
    high = max(len(image) for image in images)
    filled = [np.pad(i, ((high - len(i), 0), (0, 0), (0, 0)), mode="edge") for i in images]
    picture = folder / "15_round.png"
    picture.write_bytes(png8(np.concatenate(filled, axis=1)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
