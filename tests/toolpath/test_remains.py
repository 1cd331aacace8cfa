"""What is left of the stock, against a plain minimum over every place."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.remains import after

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
