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
from envelope import relief as relief_of_hills

import relieffab as rf
from relieffab import profiles
from relieffab.compiled import kernel
from relieffab.gcode.estimate import estimate
from relieffab.gcode.read import read_program
from relieffab.gcode.simulate import simulate
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import cutting
from relieffab.stock import Stock
from relieffab.toolpath.bench import Bench
from relieffab.toolpath.envelope import Terrain, nodes, tip_surface
from relieffab.toolpath.link import Linking, link
from relieffab.toolpath.outline import height_at, outline_of, radius_at
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.plan import REACH, plan
from relieffab.toolpath.settings import Settings

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


def reachable(relief, cutter):
    """Excess that a cutter cannot help leaving at the relief's nodes, mm."""
    tips = tip_surface(Terrain.of(relief), cutter, nodes(relief.grid))
    low = tips.min()
    turned = tip_surface(Terrain.over(relief.grid, low - tips), cutter, nodes(relief.grid))
    return low - turned - relief.heights


def upright(relief):
    """Cosine of the steepest slope next to each node."""
    down, across = np.gradient(relief.heights, relief.grid.pitch)
    return 1 / np.hypot(1, np.hypot(down, across))


def judge(folder):
    """Plan, write, run and measure."""
    relief = rf.read_relief(Path(folder) / "relief.tiff")
    machine, material = profiles.machine("3018-prover"), profiles.material("softwood")
    cutters = tuple(profiles.cutter(name) for name in CUTTERS)
    x, y = relief.grid.node_axes()
    stock = Stock(float(x[-1]), float(y[0]), 12.0)
    for _ in range(2):
        start = time.perf_counter()
        paths = plan(relief, (), machine, material, cutters=cutters, stock=stock)
        texts = [write_program(path, machine, stock, depth=relief.depth) for path in paths]
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
    carved = simulate(programs, [path.cutter for path in paths], relief.grid, stock, refine=1)
    excess = carved.heights - relief.heights
    figure = relief.heights < 0
    square = excess * upright(relief)
    best = reachable(relief, cutters[2])
    print(f"  within 0.05 mm: {(excess[figure] <= 0.05).mean():.2%} upright, "
          f"{(square[figure] <= 0.05).mean():.2%} square to the surface; "
          f"reach {(best[figure] <= 0.05).mean():.2%}; gouge {1e3 * max(-excess.min(), 0):.1f} um; "
          f"beyond reach by 0.05: {((excess - best)[figure] > 0.05).mean():.2%}")  # fmt: skip


def finishing():
    """Time one finishing program of rows alone, as depth-map programs make it."""
    grid = Grid.on_panel((100.0, 75.0), (1024, 768))
    heights = relief_of_hills(grid)
    relief = rf.Relief(grid, heights, np.ones(grid.shape, bool), 5.0)
    machine, cutter = profiles.machine("3018-prover"), profiles.cutter("ball-3.175")
    use = cutting(cutter, profiles.material("softwood"), machine)
    stock = Stock(100.0, 75.0, 12.0)
    for _ in range(4):
        start = time.perf_counter()
        bench = Bench(Terrain.of(relief), Settings(stepover=3 * grid.pitch, tolerance=0.01))
        points, feed = link(bench.finish(cutter, 5.0), Linking(machine, use, REACH))
        planned = time.perf_counter() - start
        path = Toolpath("finish", points, feed, cutter, use.rpm)
        text = write_program(path, machine, stock, depth=relief.depth)
        seconds = time.perf_counter() - start
        print(f"1024 x 768, every third row, ball 3.175: {planned:.2f} s planned, "
              f"{seconds:.2f} s with writing, {text.count(chr(10)):,} lines")  # fmt: skip


if __name__ == "__main__":
    finishing()
    for given in sys.argv[1:]:
        judge(given)
