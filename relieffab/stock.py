"""Stock: the slab before anything is cut from it."""

from dataclasses import dataclass
from itertools import product

from relieffab.errors import InputError, suggest

_ALONG = {"left": 0.0, "": 0.5, "right": 1.0}
_ACROSS = {"near": 0.0, "": 0.5, "far": 1.0}
PLACES = {
    "-".join(filter(None, (y, x))) or "centre": (_ALONG[x], _ACROSS[y])
    for y, x in product(_ACROSS, _ALONG)
}
"""Nine points of a slab by name, as shares of its width and height."""
LEVELS = ("top", "bottom")


@dataclass(frozen=True)
class Stock:
    """A rectangular slab, its face at Z0, its near left corner at X0 Y0.

    Parameters
    ----------
    width, height, thickness : float
        X, Y and Z, mm.
    work_zero : tuple of float
        Where on the panel the machine's work zero is set, panel mm: programs
        are written relative to it.  Z is 0 on the face.

    Raises
    ------
    InputError
        If a measure cannot be, or work zero is not on the stock.
    """

    width: float
    height: float
    thickness: float
    work_zero: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("width", "height", "thickness"):
            value = getattr(self, name)
            if not 0 < value < 1e5:
                raise InputError(
                    f"the stock's {name} cannot be {value:g} mm",
                    expected="more than 0, less than 100 m",
                )
        x, y, z = self.work_zero
        if not (0 <= x <= self.width and 0 <= y <= self.height and -self.thickness <= z <= 0):
            raise InputError(
                "work zero lies off the stock",
                expected=f"X 0 to {self.width:g}, Y 0 to {self.height:g}, "
                f"Z {-self.thickness:g} to 0 mm on the panel",
                found=f"X {x:g}, Y {y:g}, Z {z:g} mm",
            )

    @classmethod
    def zeroed(cls, size: tuple[float, float, float], place: str, level: str = "top") -> "Stock":
        """Set work zero at one of nine points, on the face or under the slab.

        Parameters
        ----------
        size : tuple of float
            Width, height and thickness, mm.
        place : str
            One of `PLACES`: 'near-left', 'centre', 'far' ...
        level : {'top', 'bottom'}

        Examples
        --------
        >>> Stock.zeroed((120, 90, 12), "near-right", "bottom").work_zero
        (120.0, 0.0, -12)
        """
        if place not in PLACES:
            raise InputError(
                "work zero has no such place", found=place, hint=suggest(place, PLACES)
            )
        if level not in LEVELS:
            raise InputError("work zero is at top or bottom", found=level)
        x, y = PLACES[place]
        z = 0.0 if level == "top" else -size[2]
        return cls(*size, work_zero=(x * size[0], y * size[1], z))
