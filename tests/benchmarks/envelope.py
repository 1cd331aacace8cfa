"""The cutter-location surface beside opencamlib's drop-cutter on the same relief.

Run by hand: `pip install opencamlib`, then `python tests/benchmarks/envelope.py`.
opencamlib takes a triangulation whose tree does not degenerate, so the relief here is
made of irregular triangles first (pydelatin, `pip install pydelatin`) and sampled on
the nodes for us: both then see the same smooth slopes.
"""

import resource
import sys
import time

import numpy as np

from relieffab import profiles
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain, nodes, tip_surface

PEER_POINTS = 2000
TIN_ERROR = 0.002  # mm


def relief(grid):
    """Hills 5 mm deep in an oval with a wall, and the open slopes where cutters clear it."""
    x, y = np.meshgrid(*grid.node_axes())
    width, height = grid.cols * grid.pitch, grid.rows * grid.pitch
    round_ = np.hypot((x / width - 0.5) / 0.45, (y / height - 0.5) / 0.45)
    hills = -2.5 + 1.5 * np.sin(x / 3) * np.cos(y / 4) + 0.5 * np.sin(1.3 * x + y)
    return np.where(round_ < 1, np.clip(hills, -5, 0), 0.0)


def timed(call, times=3):
    """Best of some runs after one for the compiler, s."""
    call()
    seconds = []
    for _ in range(times):
        start = time.perf_counter()
        result = call()
        seconds.append(time.perf_counter() - start)
    return min(seconds), result


def surfaces():
    """Time the whole surface for every shape."""
    grid = Grid.on_panel((100.0, 75.0), (1024, 768))
    terrain = Terrain.over(grid, relief(grid))
    print("1024 x 768 over 100 x 75 x 5 mm, at every node")
    for name in ("ball-3.175", "flat-3.175", "bull-3.175", "tapered-ball-1", "vee-60"):
        seconds, _ = timed(
            lambda name=name: tip_surface(terrain, profiles.cutter(name), nodes(grid))
        )
        print(f"  {name:16} {seconds:6.3f} s  {terrain.heights.size / seconds:12,.0f} points/s")


def large():
    """Time the ball over 4096 x 4096."""
    grid = Grid.on_panel((100.0, 100.0), (4096, 4096))
    terrain = Terrain.over(grid, relief(grid))
    seconds, _ = timed(lambda: tip_surface(terrain, profiles.cutter("ball-3.175"), nodes(grid)), 1)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"4096 x 4096, ball-3.175: {seconds:.2f} s, at most {peak:.2f} GiB in use")


def peer():
    """Compare with opencamlib on one triangulation of smooth slopes."""
    import opencamlib as ocl
    from pydelatin import Delatin

    grid = Grid.on_panel((100.0, 75.0), (1024, 768))
    x, y = np.meshgrid(*grid.node_axes())
    smooth = -2.5 + 1.5 * np.sin(x / 3) * np.cos(y / 4)
    tin = Delatin(smooth.astype(np.float32), max_error=TIN_ERROR)
    column, row, _ = tin.vertices.T
    row = grid.rows - row
    corners = np.column_stack(
        [*grid.to_xy(row, column), smooth[row.astype(int), column.astype(int)]]
    )
    surface = ocl.STLSurf()
    for face in tin.triangles:
        surface.addTriangle(ocl.Triangle(*(ocl.Point(*corners[k]) for k in face)))
    rng = np.random.default_rng(0)
    at = np.column_stack([rng.integers(100, grid.cols - 100, PEER_POINTS),
                          rng.integers(100, grid.rows - 100, PEER_POINTS)])  # fmt: skip
    places = np.column_stack(grid.to_xy(at[:, 1], at[:, 0]))
    drop = ocl.BatchDropCutter()
    drop.setSTL(surface)
    cutter = ocl.BallCutter(3.175, 20)  # opencamlib keeps no reference of its own
    drop.setCutter(cutter)
    for px, py in places:
        drop.appendPoint(ocl.CLPoint(px, py, -99))
    start = time.perf_counter()
    drop.run()
    theirs = time.perf_counter() - start
    peer_z = np.array([point.z for point in drop.getCLPoints()])
    ball = profiles.cutter("ball-3.175")
    terrain = Terrain.over(grid, smooth)
    ours, tips = timed(lambda: tip_surface(terrain, ball, nodes(grid)))
    exact = true_tips(places, ball.radius)
    both = tips[at[:, 1], at[:, 0]]
    rates = PEER_POINTS / theirs, tips.size / ours
    errors = [1e3 * np.abs(z - exact).max() for z in (peer_z, both)]
    print(f"opencamlib on {len(tin.triangles):,} triangles, ball 3.175, smooth slopes")
    for name, rate, error in zip(("theirs", "ours"), rates, errors, strict=True):
        print(f"  {name:8}{rate:12,.0f} points/s, off the formula by {error:.2f} um")
    print(f"  ratio   {rates[1] / rates[0]:12,.0f}")
    print(f"  between the two {1e3 * np.abs(both - peer_z).max():.2f} um")


def true_tips(places, radius):
    """Tip heights on the formula's own surface, by dense sampling about each contact."""
    span, (px, py) = np.linspace(-radius, radius, 81), (places[:, 0].copy(), places[:, 1].copy())
    best = None
    for _ in range(4):
        sx, sy = px[:, None, None] + span[:, None], py[:, None, None] + span
        away = (sx - places[:, :1, None]) ** 2 + (sy - places[:, 1:, None]) ** 2
        fall = radius - np.sqrt(np.maximum(radius**2 - away, 0.0))
        gap = np.where(
            away < radius**2, -2.5 + 1.5 * np.sin(sx / 3) * np.cos(sy / 4) - fall, -np.inf
        )
        k = gap.reshape(len(places), -1).argmax(axis=1)
        best = gap.reshape(len(places), -1)[np.arange(len(places)), k]
        px, py = px + span[k // 81], py + span[k % 81]
        span = span / 20
    return best


if __name__ == "__main__":
    surfaces()
    sys.stdout.flush()
    peer()
    large()
