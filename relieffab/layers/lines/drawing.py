"""Drawing: what is drawn of a model, and how."""

from dataclasses import dataclass

import numpy as np

from relieffab.errors import InputError
from relieffab.layers.lines.names import USUAL, chosen


@dataclass(frozen=True)
class Drawing:
    """Which lines are drawn, and how.

    Parameters
    ----------
    kinds : tuple of str
        Some of `names.NAMES`.
    detail : float
        Forms of this wavelength lose half their height before lines are sought,
        finer ones nearly all, mm; 0 keeps all.
    min_length : float
        Shorter lines are left out, mm.
    spacing : float
        A weaker line that runs nearer than this beside a stronger one is left
        out, mm.
    tolerance : float
        How far a stroke may be simplified, mm.
    secondary : float
        Strength of lines that bound no form against that of contours, 0 to 1.
    width : float
        Of a stroke, mm.
    spread : float
        How far ink is dilated (above 0) or eroded (below 0), mm; under a pixel, nothing.
    """

    kinds: tuple[str, ...] = USUAL
    detail: float = 1.8
    min_length: float = 3.0
    spacing: float = 0.6
    tolerance: float = 0.01
    secondary: float = 0.5
    width: float = 0.6
    spread: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "kinds", chosen(self.kinds))
        for name in ("detail", "min_length", "spacing", "tolerance", "width"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise InputError(
                    f"{name} of the lines is not a length",
                    expected="0 mm or more",
                    found=f"{value} mm",
                )
        if not abs(self.spread) <= 3 * self.width:
            raise InputError(
                "spread of the lines is out of range",
                expected=f"three widths at most either way, {3 * self.width:g} mm",
                found=f"{self.spread:g} mm",
            )
        if not 0 <= self.secondary <= 1:
            raise InputError(
                "secondary of the lines is not a share",
                expected="0 to 1",
                found=f"{self.secondary}",
            )
