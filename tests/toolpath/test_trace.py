"""Samples along lines, and chords that never pass below the surface."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.trace import SKIN, Trace, follow, sample

COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 800.0, "plunge": 200.0, "rpm": 9000.0}
CUTTERS = {
    "flat": Cutter("c", "flat", 1.0, **COMMON),
    "tapered ball": Cutter("c", "tapered ball", 2.0, angle=10, tip_diameter=0.5, **COMMON),
    "vee": Cutter("c", "vee", 2.0, angle=60, tip_diameter=0.1, **COMMON),
}


def terrain():
    """Walls, slopes and spikes, 60 x 60 pixels of 0.1 mm."""
    rng = np.random.default_rng(4)
    grid = Grid(60, 60, 0.1, (0.0, 6.0))
    x, y = np.meshgrid(*grid.node_axes())
    heights = -1.5 + 0.5 * np.sin(2 * x) * np.cos(3 * y)
    heights[np.hypot(x - 2, y - 3) < 0.8] = -0.2
    heights[rng.random(heights.shape) < 0.01] = 0.0
    return Terrain.over(grid, np.where(np.hypot(x - 3, y - 3) < 2.6, heights, 0.0))


def between(trace, parts=9):
    """Points on the chords of a trace."""
    at = np.flatnonzero(trace.joined)
    share = np.arange(parts)[:, None] / parts
    xy = [trace.xy[at, k] * (1 - share) + trace.xy[at + 1, k] * share for k in (0, 1)]
    return xy[0], xy[1], trace.z[at] * (1 - share) + trace.z[at + 1] * share


def test_samples_hold_every_vertex_and_are_close():
    line = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.25]])
    trace = sample([line, line + 5], 0.1)
    assert trace.steps[trace.joined].max() <= 0.1 + 1e-9
    assert np.allclose(trace.xy[trace.corner][:3], line)
    assert np.unique(trace.run).tolist() == [0, 1]
    assert (~trace.joined).sum() == 1


@pytest.mark.parametrize("name", CUTTERS)
def test_no_chord_passes_below_the_cutter_locations(name):
    ground = terrain()
    lines = [np.array([[0.2, y], [5.8, y + 0.3]]) for y in np.linspace(0.5, 5.2, 12)]
    lines.append(np.column_stack([np.linspace(1, 5, 9), 3 + np.sin(np.arange(9.0))]))
    trace = follow(ground, CUTTERS[name], sample(lines, 0.05))
    x, y, z = between(trace)
    assert (z - tip_heights(ground, CUTTERS[name], x, y)).min() > -0.003


def test_without_refinement_chords_do_gouge():
    ground, flat = terrain(), CUTTERS["flat"]
    trace = sample([np.array([[0.2, y], [5.8, y]]) for y in np.linspace(0.5, 5.2, 12)], 0.05)
    raw = tip_heights(ground, flat, *trace.xy.T, allowance=SKIN)
    x, y, z = between(Trace(trace.xy, raw, trace.run, trace.corner))
    assert (z - tip_heights(ground, flat, x, y)).min() < -0.05


def test_refined_samples_stay_close_to_the_surface():
    ground, ball = terrain(), CUTTERS["tapered ball"]
    trace = follow(ground, ball, sample([np.array([[0.2, 3.0], [5.8, 3.0]])], 0.05))
    above = trace.z - tip_heights(ground, ball, *trace.xy.T, allowance=SKIN)
    assert above.min() >= -1e-12
    assert np.quantile(above, 0.9) < 0.002


def test_what_is_dropped_already_is_only_refined():
    ground, flat = terrain(), CUTTERS["flat"]
    bare = sample([np.array([[0.2, 3.0], [5.8, 3.0]])], 0.05)
    z = tip_heights(ground, flat, *bare.xy.T, allowance=SKIN)
    known = Trace(bare.xy, z, bare.run, bare.corner, np.zeros(len(z)))
    one, other = follow(ground, flat, bare), follow(ground, flat, known, dropped=True)
    assert np.array_equal(one.z, other.z)
    assert np.isnan(other.top).sum() == len(other) - len(bare)


def test_turned_runs_keep_their_order():
    trace = sample([np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[0.0, 1.0], [1.0, 1.0]])], 0.5)
    turned = trace.turned()
    assert turned.xy[:, 0].tolist() == [1, 0.5, 0, 1, 0.5, 0]
    assert turned.xy[:, 1].tolist() == [0, 0, 0, 1, 1, 1]


def test_nothing_to_follow_is_no_fault():
    assert len(follow(terrain(), CUTTERS["flat"], sample([], 0.1))) == 0


def test_a_clipped_run_is_two():
    trace = sample([np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[1.0, 1.0], [0.0, 1.0]])], 0.25)
    kept = trace.clipped(np.abs(trace.xy[:, 0] - 0.5) > 0.1)
    assert kept.xy[:, 0].tolist() == [0.0, 0.25, 0.75, 1.0, 1.0, 0.75, 0.25, 0.0]
    assert kept.joined.tolist() == [True, False, True, False, True, False, True]
    assert len(trace.clipped(np.zeros(len(trace), bool))) == 0
    assert len(trace.pick(np.zeros(len(trace), bool)).clipped(np.zeros(0, bool))) == 0
