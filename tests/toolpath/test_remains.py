"""What is left of the stock, against a plain minimum over every place."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.remains import after, worthwhile
from relieffab.toolpath.trace import Trace

COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 800.0, "plunge": 200.0, "rpm": 9000.0}
GRID = Grid(30, 40, 0.1, (2.0, 5.0))


@pytest.mark.parametrize(
    "cutter",
    [
        Cutter("c", "flat", 0.55, **COMMON),
        Cutter("c", "ball", 0.75, **COMMON),
        Cutter("c", "bull", 0.75, corner_radius=0.2, **COMMON),
        Cutter("c", "tapered ball", 2.0, angle=20, tip_diameter=0.4, **COMMON),
    ],
    ids=lambda cutter: cutter.shape,
)
def test_every_node_is_cut_to_the_lowest_profile_above_it(cutter):
    rng = np.random.default_rng(7)
    tips = np.column_stack(
        [rng.uniform(1.8, 6.2, 60), rng.uniform(1.8, 5.2, 60), rng.uniform(-1.5, 0.3, 60)]
    )
    stock = -0.1 * rng.random(GRID.node_shape)
    kept = stock.copy()
    x, y = np.meshgrid(*GRID.node_axes())
    slow = stock.copy()
    for tx, ty, tz in tips:
        slow = np.minimum(slow, tz + cutter.profile(np.hypot(x - tx, y - ty)))
    assert np.allclose(after(stock, GRID, cutter, tips), slow, atol=1e-9)
    assert np.array_equal(stock, kept)
    assert (slow < stock).any()


BALL = Cutter("c", "ball", 0.8, **COMMON)


def row(y, z=-0.3, x=(2.3, 5.7)):
    at = np.arange(*x, 0.05)
    xy = np.column_stack([at, np.full(len(at), y)])
    return xy, np.full(len(at), z)


def runs(*rows):
    xy, z = (np.concatenate(parts) for parts in zip(*rows, strict=True))
    number = np.repeat(np.arange(len(rows)), [len(part) for _, part in rows])
    return Trace(xy, z, number, np.zeros(len(z), bool))


def test_a_run_over_what_another_has_cut_is_not_worth_it():
    trace = runs(row(3.0), row(3.0), row(3.8))
    worth, left = worthwhile(np.zeros(GRID.node_shape), GRID, BALL, trace, least=0.005)
    assert [worth[trace.run == k].mean() > 0.9 for k in range(3)] == [True, False, True]
    tips = np.column_stack([trace.xy, trace.z])[worth]
    assert np.abs(left - after(np.zeros(GRID.node_shape), GRID, BALL, tips)).max() < 0.003


def test_ends_that_bite_nothing_are_trimmed():
    trace = runs(row(3.0, x=(3.0, 4.5)), row(3.0))
    worth, _ = worthwhile(np.zeros(GRID.node_shape), GRID, BALL, trace, least=0.005)
    second = trace.xy[(trace.run == 1) & worth]
    assert not ((second[:, 0] > 3.1) & (second[:, 0] < 4.4)).any()
    assert second[:, 0].min() < 2.35
    assert second[:, 0].max() > 5.6


def test_above_the_face_nothing_is_cut():
    worth, left = worthwhile(
        np.zeros(GRID.node_shape), GRID, BALL, runs(row(3.0, z=0.1)), least=0.005
    )
    assert not worth.any()
    assert not left.any()
