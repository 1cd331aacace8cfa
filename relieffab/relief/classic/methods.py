"""The classic methods by name."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.relief.classic.bilateral import bilateral
from relieffab.relief.classic.gradient import gradient
from relieffab.relief.classic.histogram import histogram
from relieffab.relief.classic.linear import linear
from relieffab.relief.classic.wang import wang
from relieffab.relief.classic.weyrich import weyrich

Method = Callable[[Layers, float], NDArray[np.float64]]
"""Layers and depth (mm) to heights at nodes (mm, -depth to 0; 0 outside the figure)."""

METHODS: dict[str, Method] = {
    "linear": linear,
    "gradient": gradient,
    "bilateral": bilateral,
    "histogram": histogram,
    "weyrich": weyrich,
    "wang": wang,
}
