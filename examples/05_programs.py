"""Programs proved before a spindle turns: where the cutters go, and what they leave."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import relieffab as rf
from relieffab.picture import png8

COLOURS = {"rough": (90, 90, 160), "finish": (60, 140, 90), "lines": (200, 80, 40)}


def run(folder: Path, width: int = 512) -> Path:
    """Plan, write and verify the scarab's programs; return a picture of paths and deviation."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    layers = rf.make_layers(mesh, rf.View(up="y"), resolution=(width, 3 * width // 4))
    relief, _ = rf.make_relief(layers, rf.Carving(depth=2.0))
    machine, stock = rf.profiles.machine("3018-prover"), rf.Stock(120, 90, 10)
    wood = rf.profiles.material("softwood")
    paths = rf.plan(relief, layers.strokes, machine, wood, stock=stock)
    setup, slab = rf.Setup(machine, wood, stock, relief.depth), rf.Slab.whole(relief.grid, stock)
    programs = [rf.write_program(rf.eased(path, setup, slab), setup, slab) for path in paths]
    verdict = rf.verify(programs, [path.cutter for path in paths], relief, setup)
    if not verdict.ok:
        raise SystemExit("\n".join(verdict.findings))

    scale = 8
    drawing = Image.new("RGB", (120 * scale, 90 * scale), "white")
    draw = ImageDraw.Draw(drawing)
    for path in paths:
        for a, b, feed in zip(path.points[:-1], path.points[1:], path.feed[1:], strict=True):
            if np.isfinite(feed):
                ends = [(p[0] * scale, (90 - p[1]) * scale) for p in (a, b)]
                draw.line(ends, fill=COLOURS[path.name])
    left = np.clip(verdict.deviation / 0.1, 0, 1)
    warm = np.stack([np.full_like(left, 255), 255 * (1 - 0.6 * left), 255 * (1 - left)], axis=2)
    leftover = Image.fromarray(warm.astype(np.uint8)).resize(drawing.size)
    picture = folder / "05_programs.png"
    picture.write_bytes(png8(np.hstack([np.asarray(drawing), np.asarray(leftover)])))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
