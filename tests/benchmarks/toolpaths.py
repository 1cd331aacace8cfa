"""What programs of three cutters leave of reliefs, and how much of their way is in vain.

Run by hand: `python tests/benchmarks/toolpaths.py DIR ...`, folders that `relieffab
relief --reachable yes --lines tapered-ball-1` has made.  Rough 3.175 flat, finish
3.175 ball, rest 1 mm tapered ball.  Shares are of the figure's nodes; `reach` is what
the last cutter could make of them with all the time in the world.
"""

import sys
import time
from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab import profiles
from relieffab.compiled import kernel
from relieffab.gcode.ease import eased
from relieffab.gcode.estimate import estimate
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import verify
from relieffab.gcode.write import write_program
from relieffab.stock import Stock
from relieffab.toolpath.outline import height_at, outline_of, radius_at
from relieffab.toolpath.plan import plan
from relieffab.toolpath.reach import leaves

CUTTERS = "flat-3.175", "ball-3.175", "tapered-ball-1"
SPACING = 0.2  # mm, of the places where a cut is told from air
BITE = 0.001  # mm, less is air


@kernel
def bites(stock, pitch, x, y, z, outline, out):
    """Lower a stock place by place; say whether each took anything off a node."""
    for k in range(x.size):
        reach = radius_at(outline, -z[k])
        for i in range(
            max(int(np.ceil((y[k] - reach) / pitch)), 0),
            min(int(np.floor((y[k] + reach) / pitch)), stock.shape[0] - 1) + 1,
        ):
            half = np.sqrt(max(reach * reach - (i * pitch - y[k]) ** 2, 0.0))
            for j in range(
                max(int(np.ceil((x[k] - half) / pitch)), 0),
                min(int(np.floor((x[k] + half) / pitch)), stock.shape[1] - 1) + 1,
            ):
                r = min(np.hypot(j * pitch - x[k], i * pitch - y[k]), reach)
                height = z[k] + height_at(outline, r)
                if height < stock[i, j] - BITE:
                    out[k] = True
                stock[i, j] = min(stock[i, j], height)


def air_share(path, stock, grid):
    """Length of a path's moves at a feed that cut nothing, over all of them."""
    steps = np.diff(path.points, axis=0)
    parts = np.maximum(np.ceil(path.lengths[1:] / SPACING), 1).astype(int)
    which = np.repeat(np.arange(len(steps)), parts)
    share = 1 - (np.repeat(np.cumsum(parts), parts) - np.arange(len(which)) - 1) / parts[which]
    at = path.points[which] + steps[which] * share[:, None]
    row, col = grid.to_index(at[:, 0], at[:, 1])
    out = np.zeros(len(at), bool)
    bites(stock, grid.pitch, col * grid.pitch, row * grid.pitch, at[:, 2].copy(),
          outline_of(path.cutter), out)  # fmt: skip
    length = (path.lengths[1:] / parts)[which]
    cutting = np.isfinite(path.feed[1:])[which]
    return float(length[cutting & ~out].sum()), float(length[cutting].sum())


def upright(relief):
    """Cosine of the steepest slope next to each node."""
    down, across = np.gradient(relief.heights, relief.grid.pitch)
    return 1 / np.hypot(1, np.hypot(down, across))


def written(paths, setup, slab):
    """Ease and write toolpaths; texts, and the paths as written."""
    texts, done = [], []
    for path in paths:
        done.append(eased(path, setup, slab))
        texts.append(write_program(done[-1], setup, slab))
    return texts, done


def judge(folder):
    """Plan, write, run and measure."""
    relief = rf.read_relief(Path(folder) / "relief.tiff")
    machine, material = profiles.machine("3018-prover"), profiles.material("softwood")
    cutters = tuple(profiles.cutter(name) for name in CUTTERS)
    x, y = relief.grid.node_axes()
    stock = Stock(float(x[-1]), float(y[0]), 12.0)
    setup = Setup(machine, material, stock, relief.depth)
    for _ in range(2):
        start = time.perf_counter()
        paths = plan(relief, (), machine, material, cutters=cutters, stock=stock)
        texts, paths = written(paths, setup, Slab.whole(relief.grid, stock))
        seconds = time.perf_counter() - start
    print(f"{folder}: {seconds:.2f} s planned and written")
    programs = [read_program(text, name=path.name) for text, path in zip(texts, paths, strict=True)]
    left = np.zeros(relief.grid.node_shape)
    air, length, retracts, whole = 0.0, 0.0, 0.0, 0.0
    for path, program in zip(paths, programs, strict=True):
        lost, all_ = air_share(path, left, relief.grid)
        time_ = estimate(program, machine)
        rapid = path.lengths[np.isinf(path.feed)].sum() / machine.max_rate[0] * 60
        lifts = int((np.diff(np.isinf(path.feed).astype(int)) == 1).sum())
        print(
            f"  {path.name:7}{len(program.line):7} lines {time_ / 60:6.1f} min, {lifts:4} lifts, "
            f"rapids {rapid / time_:6.2%}, air {lost / all_:6.2%} of {all_:7.0f} mm"
        )
        air, length, retracts, whole = air + lost, length + all_, retracts + rapid, whole + time_
    print(f"  whole: air {air / length:.2%}, rapids {retracts / whole:.2%}")
    verdict = verify(programs, [path.cutter for path in paths], relief, setup)
    excess = verdict.deviation[::4, ::4]
    figure = relief.heights < 0
    square = excess * upright(relief)
    best = leaves(relief.heights, relief.grid.pitch, cutters[2]) - relief.heights
    print(f"  within 0.05 mm: {(excess[figure] <= 0.05).mean():.2%} upright, "
          f"{(square[figure] <= 0.05).mean():.2%} square to the surface; "
          f"reach {(best[figure] <= 0.05).mean():.2%}; gouge {1e3 * verdict.gouge_mm:.1f} um; "
          f"beyond reach by 0.05: {((excess - best)[figure] > 0.05).mean():.2%}")  # fmt: skip


if __name__ == "__main__":
    for given in sys.argv[1:]:
        judge(given)
