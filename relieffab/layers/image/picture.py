"""Picture: the pixels of one image file, as they were meant."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Picture:
    """The pixels of an image; arrays are read-only.

    Parameters
    ----------
    values : (rows, cols, 1 or 3) ndarray
        Grey, or red, green and blue: whole numbers as 0 to 1, floating point as it
        is, NaN where it knows nothing.
    alpha : (rows, cols) ndarray or None
        Opacity, 0 to 1.
    bits : int or None
        Of a channel; None for floating point.
    format : str
        Of the file, as 'PNG'.
    name : str
    notes : tuple of str
        What was done to read it.
    """

    values: Floats
    alpha: Floats | None
    bits: int | None
    format: str
    name: str
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self.values.flags.writeable = False
        if self.alpha is not None:
            self.alpha.flags.writeable = False

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.values.shape[0], self.values.shape[1]

    @property
    def coloured(self) -> bool:
        """Whether its three channels differ."""
        v = self.values
        return v.shape[2] == 3 and not np.array_equal(
            np.nan_to_num(v[..., 0]), np.nan_to_num(v[..., 1])
        )

    @property
    def grey(self) -> Floats:
        """Brightness, (rows, cols): Rec. 709 luma where there are colours."""
        if self.values.shape[2] == 1 or not self.coloured:
            return self.values[..., 0]
        return self.values @ np.array([0.2126, 0.7152, 0.0722])
