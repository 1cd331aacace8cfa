from collections.abc import Callable

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.model import Relief


def relief_of(heights: np.ndarray, pitch: float = 1.0, rim: float = 1.0) -> Relief:
    """A relief of given node heights, `rim` mm inside the stock's near left corner."""
    heights = np.array(heights, float)
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    grid = Grid(rows, cols, pitch, (rim, rim + rows * pitch))
    return Relief(grid, heights, np.ones((rows, cols), bool), max(2.0, -heights.min()))


def bumpy_heights(rows: int = 72, cols: int = 96) -> np.ndarray:
    """A smooth figure with bumps, a groove and walls of 1 to 3 mm, at 0.25 mm a pixel."""
    y, x = np.mgrid[0 : rows + 1, 0 : cols + 1] * 0.25
    u, v = x - cols / 8, y - rows / 8
    h = -2 + 0.8 * np.sin(u / 1.7) * np.cos(v / 2.1)
    h -= 0.3 * (np.abs(v - 0.4 * u) < 0.3)
    inside = np.hypot(u / 1.2, v) < 7.3 + 0.8 * np.sin(3 * np.arctan2(v, u))
    return np.where(inside, h, 0.0)


@pytest.fixture
def make_relief() -> Callable[..., Relief]:
    return relief_of


@pytest.fixture
def bumpy() -> Relief:
    return relief_of(bumpy_heights(), pitch=0.25)
