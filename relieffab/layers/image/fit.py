"""Where a picture lies on the panel, and what it shows at the panel's pixels."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.grid import Grid
from relieffab.layers.view import check_room

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SAME = 1.5
"""Pixels over the whole figure by which the picture's own may miss the panel's and still be
taken as they are: sampling anew would blur more than it set right."""
ENLARGED = 0.9
"""Pixels of the picture to one of the panel below which it is enlarged: by cubic B-splines, for
between straight lines every pixel would show as a facet, and splines through them would ring."""


@dataclass(frozen=True)
class Fit:
    """A picture's place.

    Parameters
    ----------
    grid : Grid
    scale : float
        mm a pixel of the picture.
    top, left : float
        Row and column of the picture under the centre of the grid's first pixel.
    """

    grid: Grid
    scale: float
    top: float
    left: float

    @property
    def ratio(self) -> float:
        """Pixels of the picture to one of the panel."""
        return self.grid.pitch / self.scale

    @property
    def matrix(self) -> list[list[float]]:
        """Homogeneous, from the picture's column and row (centres) to the panel's X and Y, mm."""
        x, y = self.grid.to_xy(0.5 - self.top / self.ratio, 0.5 - self.left / self.ratio)
        return [[self.scale, 0.0, x], [0.0, -self.scale, y], [0.0, 0.0, 1.0]]

    def _sample(self, values: Floats, sigma: float) -> Floats:
        rows, cols = self.grid.shape
        if self.ratio == 1.0:
            return _cut(values, int(self.top), int(self.left), (rows, cols))
        at = np.meshgrid(
            self.top + np.arange(rows) * self.ratio,
            self.left + np.arange(cols) * self.ratio,
            indexing="ij",
        )
        calm = ndimage.gaussian_filter(values, sigma, mode="constant") if sigma else values
        order = 3 if self.ratio < ENLARGED else 1
        return np.asarray(
            ndimage.map_coordinates(calm, at, order=order, mode="constant", prefilter=False)
        )

    def mask(self, mask: Bools) -> Bools:
        """Take a mask at the panel's pixels."""
        return self._sample(mask.astype(float), self._sigma) > 0.5

    def field(self, values: Floats, mask: Bools) -> Floats:
        """Take values at the panel's pixels, from those in the mask alone.

        Parameters
        ----------
        values : (rows, cols) ndarray
            Of the picture.
        mask : (rows, cols) ndarray of bool
            Where they count.

        Returns
        -------
        (rows, cols) ndarray
            On the grid; 0 far from the mask.
        """
        mass = self._sample(mask.astype(float), self._sigma)
        total = self._sample(np.where(mask, values, 0.0), self._sigma)
        return np.divide(total, mass, out=np.zeros_like(total), where=mass > 1e-6)

    @property
    def _sigma(self) -> float:
        """Deviation of the Gaussian that keeps a finer picture from shimmering, pixels of it."""
        return 0.4 * self.ratio if self.ratio > 1.0 else 0.0


def _cut(values: Floats, top: int, left: int, shape: tuple[int, int]) -> Floats:
    """Cut a window out, with zeros beyond the array."""
    out = np.zeros(shape)
    rows, cols = (slice(max(0, -s), max(0, min(n, m - s))) for s, n, m in zip(
        (top, left), shape, values.shape, strict=True
    ))  # fmt: skip
    out[rows, cols] = values[
        rows.start + top : rows.stop + top, cols.start + left : cols.stop + left
    ]
    return out


@dataclass(frozen=True, eq=False)
class Fitted:
    """What is seen of a picture where a fit lays it.

    Parameters
    ----------
    fit : Fit
        Where the picture lies on the panel.
    """

    fit: Fit

    @property
    def grid(self) -> Grid:
        """The panel's pixels."""
        return self.fit.grid

    @property
    def matrix(self) -> list[list[float]]:
        """From the picture's column and row to the panel, mm."""
        return self.fit.matrix


def fit_on(mask: Bools, grid: Grid, size: tuple[float, float], *, margin: float) -> Fit:
    """Lay a figure on the panel, centred, as large as fits, as `view.place` lays a mesh.

    Parameters
    ----------
    mask : (rows, cols) ndarray of bool
        The picture's figure.
    grid : Grid
    size : tuple of float
        The panel's X and Y, mm.
    margin : float
        Flat border that stays free all round, mm.

    Returns
    -------
    Fit
        Pixel on pixel where it all but is.

    Raises
    ------
    InputError
        If the margin leaves no room.
    """
    room = check_room(size, margin)
    rows, cols = (np.flatnonzero(mask.any(axis=axis))[[0, -1]] for axis in (1, 0))
    high, wide = float(np.ptp(rows) + 1), float(np.ptp(cols) + 1)
    scale = float(min(room[0] / wide, room[1] / high))
    middle = grid.to_index(size[0] / 2, size[1] / 2)
    ratio = grid.pitch / scale
    same = abs(1.0 / ratio - 1.0) * max(high, wide) < SAME
    ratio = 1.0 if same else ratio
    top, left = (
        (pair[0] + pair[1]) / 2 - (float(centre) - 0.5) * ratio
        for pair, centre in zip((rows, cols), middle, strict=True)
    )
    if same:
        top, left = float(round(top)), float(round(left))
    return Fit(grid, grid.pitch / ratio, top, left)
