"""Round stocks: a column, a ring or a cup, and a board whose face is gently curved."""

from dataclasses import dataclass
from math import asin, ceil, inf, pi, sin

from relieffab.bend import Bend
from relieffab.errors import InputError
from relieffab.grid import Grid

ROUNDING = 1e-6
MEANT = 0.01
"""mm that a panel's width may be off the way round that it is meant to be."""


@dataclass(frozen=True)
class Round:
    """A column, a ring or a cup, and the flat panel that is wrapped round it.

    Parameters
    ----------
    width : float
        Of the flat panel, mm: how much of the way round it takes.  Its middle faces
        front, the rest of the face stays as it is.
    length : float
        Along the axis, the panel's height, mm.
    diameter : float
        Of the face, mm.
    bore : float
        Diameter of the hole along the axis, mm; 0 for a column.
    floor : float
        How far above the lower end the bore begins, mm; 0 where it goes through.

    Raises
    ------
    InputError
        If there is no such stock, or the panel is wider than the way round.
    """

    width: float
    length: float
    diameter: float
    bore: float = 0.0
    floor: float = 0.0

    def __post_init__(self) -> None:
        _check_lengths(width=self.width, length=self.length, diameter=self.diameter)
        around = pi * self.diameter
        if self.width > around + ROUNDING:
            raise InputError(
                "the panel is wider than the way round the face",
                expected=f"at most {around:.3f} mm at a diameter of {self.diameter:g} mm",
                found=f"{self.width:g} mm",
                where="round",
                hint=f"a narrower --size, or --round {ceil(self.width / pi * 100) / 100}mm or more",
            )
        if not 0 <= self.bore < self.diameter:
            raise InputError(
                "the bore leaves no wall",
                expected=f"under the face's diameter of {self.diameter:g} mm",
                found=f"{self.bore:g} mm",
                where="bore",
            )
        if self.floor and not self.bore:
            raise InputError(
                "a floor is given, but no bore", where="floor", hint="--bore, too, for a cup"
            )
        if not 0 <= self.floor < self.length:
            raise InputError(
                "the floor leaves no bore",
                expected=f"under the length of {self.length:g} mm",
                found=f"{self.floor:g} mm",
                where="floor",
            )

    @property
    def bend(self) -> Bend:
        """How the panel is wrapped."""
        return Bend(self.diameter / 2, self.width / 2)

    @property
    def wall(self) -> float:
        """From the face to the bore, or to the axis where there is none, mm."""
        return (self.diameter - self.bore) / 2

    @property
    def all_round(self) -> bool:
        """Whether the panel's left and right edge meet."""
        return self.width > pi * self.diameter - ROUNDING


@dataclass(frozen=True)
class Curved:
    """A board with a flat back, whose face is part of a cylinder.

    Parameters
    ----------
    width : float
        Of the flat panel that is bent over it, along the curve, mm.
    height : float
        Y, mm.
    thickness : float
        At the middle, mm.
    radius : float
        Of the face, mm.

    Raises
    ------
    InputError
        If there is no such board.
    """

    width: float
    height: float
    thickness: float
    radius: float

    def __post_init__(self) -> None:
        _check_lengths(
            width=self.width, height=self.height, thickness=self.thickness, curved=self.radius
        )
        if self.width >= self.radius * pi / 2:
            raise InputError(
                "the board is curved too strongly",
                expected=f"a radius over {self.width / pi * 2:.4g} mm, a quarter of a turn",
                found=f"{self.radius:g} mm",
                where="curved",
                hint="a larger --curved, or --round for a column",
            )
        if self.wall <= 0:
            raise InputError(
                "the curved face runs out through the back",
                expected=f"a thickness over {self.sagitta:.4g} mm",
                found=f"{self.thickness:g} mm",
                where="curved",
                hint="a larger --curved, or a larger --thickness",
            )

    @property
    def bend(self) -> Bend:
        """How the panel is bent."""
        return Bend(self.radius, self.width / 2)

    @property
    def breadth(self) -> float:
        """How wide the board itself is, mm."""
        return 2 * self.radius * sin(self.width / self.radius / 2)

    @property
    def sagitta(self) -> float:
        """How far the face falls from its middle to its sides, mm."""
        return 2 * self.radius * sin(self.width / self.radius / 4) ** 2

    @property
    def wall(self) -> float:
        """Thickness at the sides, mm."""
        return self.thickness - self.sagitta

    @property
    def all_round(self) -> bool:
        """Whether the panel's left and right edge meet: never."""
        return False


def meant_width(width: float, diameter: float) -> float:
    """Take a width that a person rounded for the way round.

    Examples
    --------
    >>> meant_width(251.33, 80) == pi * 80, meant_width(251.3, 80)
    (True, 251.3)
    """
    around = pi * diameter
    return around if abs(width - around) < MEANT else width


def check_depth(stock: Round | Curved, depth: float) -> None:
    """Refuse a relief as deep as the wall.

    Raises
    ------
    InputError
    """
    if depth >= stock.wall:
        inner = "wall" if isinstance(stock, Round) else "sides of the board"
        raise InputError(
            "the relief would cut through the stock",
            expected=f"a depth under the {inner}'s {stock.wall:.4g} mm",
            found=f"{depth:g} mm",
            where="depth",
            hint="a smaller --depth, or a smaller --bore"
            if isinstance(stock, Round)
            else "a smaller --depth, or a larger --thickness",
        )


def check_on(stock: Round | Curved, grid: Grid) -> None:
    """Refuse a relief that reaches beyond its panel.

    Raises
    ------
    InputError
    """
    height = stock.length if isinstance(stock, Round) else stock.height
    (x0, y0), (x1, y1) = grid.to_xy(grid.rows, 0), grid.to_xy(0, grid.cols)
    if min(x0, y0) < -ROUNDING or x1 > stock.width + ROUNDING or y1 > height + ROUNDING:
        raise InputError(
            "the relief reaches beyond the stock",
            expected=f"X 0 to {stock.width:g}, Y 0 to {height:g} mm",
            found=f"X {x0:g} to {x1:g}, Y {y0:g} to {y1:g} mm",
        )


def chord(radius: float, error: float) -> float:
    """Angle of the chord that stays within an error of its arc, radians.

    Examples
    --------
    >>> round(chord(40, 0.005) * 40, 2)
    1.26
    """
    return 4 * asin(min((error / (2 * radius)) ** 0.5, 0.5))


def _check_lengths(**lengths: float) -> None:
    for name, value in lengths.items():
        if not 0 < value < inf:
            raise InputError(
                f"the stock's {name} cannot be {value:g} mm", expected="more than 0", where=name
            )
