"""Stock: the slab before anything is cut from it."""

from dataclasses import dataclass

from relieffab.errors import InputError


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
