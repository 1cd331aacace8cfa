"""Whole passes of every cutter shape over whatever walls are drawn: none gouges."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief
from relieffab.toolpath.bench import Bench
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.settings import Settings

COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 800.0, "plunge": 200.0, "rpm": 9000.0}
CUTTERS = {
    "flat": Cutter("c", "flat", 0.8, **COMMON),
    "ball": Cutter("c", "ball", 0.8, **COMMON),
    "bull": Cutter("c", "bull", 0.8, corner_radius=0.2, **COMMON),
    "vee": Cutter("c", "vee", 1.5, angle=60, tip_diameter=0.1, **COMMON),
    "tapered ball": Cutter("c", "tapered ball", 1.5, angle=20, tip_diameter=0.5, **COMMON),
    "form": Cutter("c", "form", 1.0, points=((0, 0), (0.2, 0.1), (0.5, 1.0)), **COMMON),
}
GRID = Grid(9, 12, 0.25, (0.0, 2.25))
FINE = 4
GOUGE = 0.005  # mm


def deepest_gouge(relief, parts, cutter):
    """Deepest cut below the relief, mm, at nodes four times as fine as its own."""
    x, y = relief.grid.to_xy(
        *np.meshgrid(np.arange(0, 9.01, 1 / FINE), np.arange(0, 12.01, 1 / FINE), indexing="ij")
    )
    worst = 0.0
    for part in parts:
        for run in part.runs:
            share = np.arange(0, 1, 0.125)[:, None, None]
            chords = (run[:-1] * (1 - share) + run[1:] * share).reshape(-1, 3)
            at = np.concatenate([run[-1:], chords])
            for block in np.array_split(at, max(len(at) // 500, 1)):
                away = np.hypot(x.ravel() - block[:, :1], y.ravel() - block[:, 1:2])
                surface = relief.height_at(x, y).ravel()
                worst = max(worst, (surface - block[:, 2:] - cutter.profile(away)).max())
    return worst


@pytest.mark.parametrize("name", CUTTERS)
@settings(max_examples=5, deadline=None, derandomize=True)
@given(
    heights=arrays(float, GRID.node_shape, elements=st.sampled_from([0.0, -0.3, -0.9, -1.6])),
    angle=st.sampled_from([0.0, 27.0, 90.0]),
    stepover=st.sampled_from([None, 0.2]),
)
def test_no_pass_gouges_at_four_times_the_resolution(name, heights, angle, stepover):
    relief = Relief(GRID, heights, np.ones(GRID.shape, bool), 1.6)
    cutter = CUTTERS[name]
    bench = Bench(Terrain.of(relief), Settings(stepover, angle=angle))
    line = Stroke(np.array([[0.3, 0.4], [2.6, 1.9]]), "crease", np.ones(2))
    parts = [
        *bench.rough(cutter, 0.7),
        *bench.finish(cutter, 0.7),
        *bench.lines(cutter, 0.7, strokes=[line]),
        *bench.marks(
            cutter, 0.7, marked=Terrain.of(relief), lines=[line.points, line.points[[0, 0]]]
        ),
    ]
    assert deepest_gouge(relief, parts, cutter) <= GOUGE


def test_what_is_left_is_what_the_passes_leave():
    x, y = np.meshgrid(*GRID.node_axes())
    heights = np.where(np.hypot(x - 1.5, y - 1.1) < 0.8, -0.8, 0.0)
    bench = Bench(Terrain.over(GRID, heights), Settings())
    assert not bench.left.any()
    bench.finish(CUTTERS["ball"], 2.0)
    assert (bench.left >= heights - 1e-9).all()
    assert bench.left[np.hypot(x - 1.5, y - 1.1) < 0.3].max() < -0.75
