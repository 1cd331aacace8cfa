import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief

CENTRE, RADIUS, DEPTH = (30.0, 20.0), 15.0, 3.0


@pytest.fixture(scope="session")
def bowl():
    """A cone 3 mm deep and 15 mm wide, on a panel of 60 x 40 mm: contours are circles."""
    grid = Grid.on_panel((60.0, 40.0), (300, 200))
    x, y = grid.node_axes()
    away = np.hypot(x[None, :] - CENTRE[0], y[:, None] - CENTRE[1])
    heights = -DEPTH * np.clip(1 - away / RADIUS, 0, 1)
    mask = heights[:-1, :-1] < 0
    return Relief(grid, heights, mask, DEPTH)


@pytest.fixture(scope="session")
def strokes():
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    ring = np.stack([30 + 15 * np.cos(turn), 20 + 15 * np.sin(turn)], axis=1)
    across = np.array([[20.0, 20.0], [40.0, 20.0]])
    return (
        Stroke(ring, "outline", np.ones(60), closed=True),
        Stroke(across, "suggestive", np.ones(2)),
        Stroke(across + 1.0, "principal-highlight", np.ones(2)),
    )
