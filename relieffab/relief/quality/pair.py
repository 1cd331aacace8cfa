"""A relief and what it was made from, on the same pixels: what every measure starts from."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.model import Layers
from relieffab.layers.occlusion import beside, occlusions, slopes
from relieffab.relief.model import Relief, pixel_slopes

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

MARGIN = 2  # pixels along the figure's edge that most measures leave out
WALL = 0.25  # of the depth: width of the strip along edges where walls may stand
STRIP = 2.0  # pixels that the strip has in addition


def normals_of(slope: Floats) -> Floats:
    """Turn slopes into unit normals (-p, -q, 1) / sqrt(1 + p² + q²).

    Parameters
    ----------
    slope : (2, ...) ndarray
        dh/dx and dh/dy.

    Returns
    -------
    (..., 3) ndarray
    """
    steep = 1.0 / np.sqrt(1.0 + slope[0] ** 2 + slope[1] ** 2)
    return np.stack([-slope[0] * steep, -slope[1] * steep, steep], axis=-1)


def correlation(a: Floats, b: Floats) -> float:
    """Correlate a relief's figures with its model's, means taken off.

    Parameters
    ----------
    a, b : (n,) ndarray
        The model's and the relief's.

    Returns
    -------
    float
        -1 to 1; 0 if the relief's do not vary, NaN if the model's do not.
    """
    if a.size < 2 or np.ptp(a) < 1e-9:
        return float("nan")
    if np.ptp(b) < 1e-12:
        return 0.0
    x, y = a - a.mean(), b - b.mean()
    return float(x @ y / np.sqrt((x @ x) * (y @ y)))


@dataclass(frozen=True, eq=False)
class Pair:
    """A relief beside the layers of its model; what follows from them is found once.

    Parameters
    ----------
    relief : Relief
    layers : Layers
        On the same grid.
    """

    relief: Relief
    layers: Layers

    def __post_init__(self) -> None:
        mine, theirs = self.relief.grid, self.layers.grid
        if mine.shape != theirs.shape or not np.isclose(mine.pitch, theirs.pitch):
            raise InputError(
                "the relief and the layers are not on the same pixels",
                expected=f"{theirs.shape} pixels of {theirs.pitch:g} mm",
                found=f"{mine.shape} of {mine.pitch:g} mm",
            )

    @cached_property
    def inner(self) -> Bools:
        """Ms: pixels whose square of 5 x 5 pixels lies in the figure."""
        whole = np.ones((3, 3), bool)
        return ndimage.binary_erosion(self.layers.mask, whole, iterations=MARGIN)  # type: ignore[no-any-return]

    @cached_property
    def model_slopes(self) -> Floats:
        """Slopes of the model, (2, rows, cols), at most `compress.STEEPEST`."""
        return slopes(self.layers)

    @cached_property
    def torn(self) -> Bools:
        """Pixels beside an occlusion, on either side of it."""
        return beside(*occlusions(self.layers, self.model_slopes))

    @cached_property
    def sound(self) -> Bools:
        """Pixels of Ms that no occlusion touches."""
        return self.inner & ~self.torn

    @cached_property
    def from_edge(self) -> Floats:
        """Distance of the figure's pixels to the nearest one outside it or torn, in pixels."""
        whole = np.pad(self.layers.mask & ~self.torn, 1)
        return ndimage.distance_transform_edt(whole)[1:-1, 1:-1]  # type: ignore[no-any-return]

    @property
    def strip(self) -> float:
        """Width of the strip along edges and occlusions where walls may stand, pixels."""
        return WALL * self.relief.depth / self.relief.grid.pitch + STRIP

    @cached_property
    def slopes(self) -> Floats:
        """Slopes of the relief, (2, rows, cols)."""
        return pixel_slopes(self.relief.heights, self.relief.grid.pitch)

    @cached_property
    def heights(self) -> Floats:
        """Heights of the relief at pixel centres, the mean of four corners, mm."""
        h = self.relief.heights
        return (h[:-1, :-1] + h[:-1, 1:] + h[1:, :-1] + h[1:, 1:]) / 4.0
