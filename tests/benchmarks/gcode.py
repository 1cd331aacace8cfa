"""How soon a finishing program stands on disk, proved, and beside what.

    python tests/benchmarks/gcode.py            1024 x 768 pixels, 100 x 75 x 5 mm
    python tests/benchmarks/gcode.py 4096       4096 x 3072

The job is that of other programs' figures: ball 3.175 mm, every third row, simplified
within 0.01 mm, and it is done as `relieffab toolpath` does it: no chord gouges, what
is not worth a move is left out, creases are followed, no pass takes too much.  Theirs
(seconds) were measured elsewhere and stand only for the size of the ratio; where
LinuxCNC's interpreter is installed, as .ci/run does, it reads the same text in the same
run.
"""

import json
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from relieffab import profiles
from relieffab.gcode.ease import eased
from relieffab.gcode.estimate import estimate
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import verify
from relieffab.gcode.write import write_program
from relieffab.grbl.program import prepare
from relieffab.grid import Grid
from relieffab.machine import cutting
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath.bench import Bench
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.link import Linking, link
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.plan import REACH
from relieffab.toolpath.settings import Settings

Result = TypeVar("Result")
Floats = NDArray[np.float64]

OTHERS = {"dmap2gcode": 10.6, "LinuxCNC image-to-gcode": 16.1, "pngcam": 7.4}  # s, 1024 x 768
SIZE, DEPTH, TOLERANCE = (100.0, 75.0), 5.0, 0.01
SCRIPT = Path(__file__).parent.parent / "gcode" / "linuxcnc_canon.py"


def hills(width: int) -> Relief:
    """Smooth forms of all sizes in an oval, 5 mm deep."""
    grid = Grid.on_panel(SIZE, (width, 3 * width // 4))
    x, y = np.meshgrid(*grid.node_axes())
    rng = np.random.default_rng(1)
    heights = np.zeros(grid.node_shape)
    for _ in range(60):
        at, wide = rng.uniform((15, 12), (85, 63)), rng.uniform(3, 15)
        away = ((x - at[0]) ** 2 + (y - at[1]) ** 2) / wide**2
        heights -= rng.uniform(0.2, 1.6) * np.exp(-2 * away)
    inside = np.hypot((x - 50) / 44, (y - 37.5) / 32) < 1
    mask = inside[:-1, :-1] & inside[1:, 1:]
    return Relief(grid, np.clip(heights, -DEPTH, 0) * inside, mask, DEPTH)


def timed(work: Callable[[], Result]) -> tuple[Result, float]:
    """Run once; the result, and seconds."""
    start = perf_counter()
    result = work()
    return result, perf_counter() - start


def planned(relief: Relief, left: Floats, setup: Setup) -> tuple[Toolpath, float, float]:
    """Every third row as `toolpath` plans it, creases after; seconds of ways and of links."""
    cutter = profiles.cutter("ball-3.175")
    use = cutting(cutter, setup.material, setup.machine)
    bench = Bench(Terrain.of(relief), Settings(stepover=3 * relief.grid.pitch, tolerance=TOLERANCE))
    bench.left = left
    parts, ways = timed(lambda: bench.finish(cutter, use.stepdown))
    (points, feed), links = timed(lambda: link(parts, Linking(setup.machine, use, REACH)))
    return Toolpath("finish", points, feed, cutter, use.rpm), ways, links


def interpreted(text: str) -> float | None:
    """Seconds LinuxCNC's interpreter takes for a program; None where it is not installed."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "program.ngc")
        path.write_text(text, encoding="ascii")
        command = ["/usr/bin/python3", "-E", str(SCRIPT), folder, str(path)]
        try:
            ran, seconds = timed(lambda: subprocess.run(command, capture_output=True, check=False))
        except OSError:
            return None
    return None if ran.returncode or json.loads(ran.stdout)["fault"] else seconds


def finish(width: int) -> None:
    """Print the time to a written program, and what it takes to prove it."""
    relief = hills(width)
    machine, material = profiles.machine("shapeoko-3"), profiles.material("softwood")
    stock = Stock(*SIZE, 12.0)
    setup = Setup(machine, replace(material, stepdown=2.0, use=()), stock, DEPTH)
    # The finisher meets what roughing left: the relief with an allowance.
    rough = Slab.whole(relief.grid, stock)
    here = rough.heights[: relief.heights.shape[0], : relief.heights.shape[1]]
    here[:] = np.minimum(relief.heights + 0.5, 0)
    before = process_time()
    path, ways, links = planned(relief, here.astype(float), setup)
    slow, easing = timed(lambda: eased(path, setup, rough))
    text, writing = timed(lambda: write_program(slow, setup, rough.copy()))
    total, worked = ways + links + easing + writing, process_time() - before
    lines = text.count("\n")
    print(f"{width} x {3 * width // 4}, ball 3.175, every third row, within {TOLERANCE} mm")
    print(
        f"  ways {ways:.2f} s, joined {links:.2f} s, eased {easing:.2f} s, written {writing:.2f} s"
    )
    print(f"  total {total:.2f} s, {worked:.2f} s of processors")
    print(f"  {lines:,} lines, {len(text) / 1e6:.2f} MB")
    if width == 1024:
        for name, seconds in OTHERS.items():
            print(f"  {name} (measured elsewhere) {seconds} s: {seconds / total:.1f} times as long")
    read, reading = timed(lambda: read_program(text))
    print(f"  read back in {reading:.2f} s, {lines / reading:,.0f} lines a second")
    canon = interpreted(text)
    if canon:
        print(f"  LinuxCNC's interpreter {canon:.2f} s: {canon / reading:.1f} times as long")
    _, ready = timed(lambda: prepare(text))
    print(f"  the sender's own pass over it {ready:.2f} s")
    seconds, foretelling = timed(lambda: estimate(read, machine))
    print(f"  takes {seconds / 60:.1f} min on {machine.name}, foretold in {foretelling:.3f} s")
    verdict, proving = timed(lambda: verify([read], [path.cutter], relief, setup))
    print(
        f"  judged at {relief.grid.cols * 4} x {relief.grid.rows * 4} in {proving:.2f} s: ", end=""
    )
    print(f"gouge {verdict.gouge_mm * 1000:.1f} um, air {verdict.air_cutting:.1%}")
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"  most memory {used:.2f} GiB")


if __name__ == "__main__":
    finish(256)  # compiles
    print()
    finish(int(sys.argv[1]) if len(sys.argv) > 1 else 1024)
