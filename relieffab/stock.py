"""Stock: the slab before a relief is cut into it, with its frame and holes."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError, suggest
from relieffab.fittings import LEVELS, PLACES, Edge, Frame, Hole, Keyhole, Kind, Place
from relieffab.outline import Outline

WALL = 1.0  # mm of material that must stay beside holes, and over keyholes


@dataclass(frozen=True)
class Stock:
    """A slab, its face at Z0, the near left corner of its outline's box at X0 Y0.

    Parameters
    ----------
    width, height, thickness : float
        X, Y and Z under the face, mm.
    work_zero : tuple of float
        Where on the panel the machine's work zero is set, panel mm: programs
        are written relative to it.  Z is 0 on the face.
    shape : {'rectangle', 'round', 'arched'}
        See `relieffab.outline.Outline`.
    corner : float
        Radius of the outline's corners, mm.
    frame : Frame or None
    holes : tuple of Hole
    keyholes : tuple of Keyhole
    turned : bool
        Whether it lies on the machine turned half round about Z.
    radius : float
        Of the face of a round stock, laid out flat here with its axis along X, mm;
        Z is square to the face.  Programs mirror its Y, see `relieffab.relief.laid`.  0 for a
        flat one.
    curve : float
        Radius of a face that is curved along X, its middle at Z0, mm; 0 for a level one.

    Raises
    ------
    InputError
        If a measure cannot be, or work zero is not on the stock.
    """

    width: float
    height: float
    thickness: float
    work_zero: tuple[float, float, float] = (0.0, 0.0, 0.0)
    shape: Kind = "rectangle"
    corner: float = 0.0
    frame: Frame | None = None
    holes: tuple[Hole, ...] = ()
    keyholes: tuple[Keyhole, ...] = ()
    turned: bool = False
    radius: float = 0.0
    curve: float = 0.0

    def __post_init__(self) -> None:
        for name in ("width", "height", "thickness"):
            value = getattr(self, name)
            if not 0 < value < 1e5:
                raise InputError(
                    f"the stock's {name} cannot be {value:g} mm",
                    expected="more than 0, less than 100 m",
                )
        x, y, z = self.work_zero
        deepest = max(self.thickness, self.radius)
        if not (0 <= x <= self.width and 0 <= y <= self.height and -deepest <= z <= 0):
            raise InputError(
                "work zero lies off the stock",
                expected=f"X 0 to {self.width:g}, Y 0 to {self.height:g}, "
                f"Z {-deepest:g} to 0 mm on the panel",
                found=f"X {x:g}, Y {y:g}, Z {z:g} mm",
            )
        outline = self.outline
        if self.frame:
            _check_frame(self.frame, outline, self.thickness)
        for hole in self.holes:
            _check_hole(hole, self)
        for keyhole in self.keyholes:
            _check_keyhole(keyhole, self)
        for one, other in combinations(self._openings(), 2):
            _check_apart(one, other)

    @property
    def outline(self) -> Outline:
        """Its outline."""
        return Outline(self.shape, self.width, self.height, self.corner)

    def to_work(self, points: ArrayLike) -> NDArray[np.float64]:
        """Turn panel coordinates (n, 3) into those of programs, mm."""
        return (np.asarray(points, float) - self.work_zero) * self._way

    def to_panel(self, points: ArrayLike) -> NDArray[np.float64]:
        """Turn coordinates of programs (n, 3) into the panel's, mm."""
        return np.asarray(points, float) * self._way + self.work_zero

    @property
    def _way(self) -> tuple[float, float, float]:
        if self.radius:
            return (1.0, -1.0, 1.0)
        return (-1.0, -1.0, 1.0) if self.turned else (1.0, 1.0, 1.0)

    @property
    def all_round(self) -> bool:
        """Whether it is a round one whose near and far edge are the same."""
        return self.radius > 0 and self.height > 2 * np.pi * self.radius - 1e-6

    def face(self, x: ArrayLike) -> NDArray[np.float64]:
        """Z of the face at X, mm; beyond the sides as at them."""
        x = np.asarray(x, float)
        if not self.curve:
            return np.zeros_like(x)
        aside = np.clip(x, 0.0, self.width) - self.width / 2
        return np.sqrt(self.curve**2 - aside**2) - self.curve

    def lowest(self, depth: float) -> float:
        """Say how far under Z0 a relief of that depth may reach, mm."""
        return depth - float(self.face(0.0))

    @property
    def plain(self) -> bool:
        """Whether it is a rectangular slab and nothing more."""
        return self.outline.plain and not (self.frame or self.holes or self.keyholes)

    @property
    def top(self) -> float:
        """Z of its highest, mm."""
        return max(self.frame.height, 0.0) if self.frame else 0.0

    @property
    def rim(self) -> float:
        """How far inside the outline the level face begins, mm."""
        if self.frame is None:
            return 0.0
        sunk = self.frame.height < 0
        return self.frame.width + (self.frame.edge.width if self.frame.edge and sunk else 0.0)

    def on_face(self, x: ArrayLike, y: ArrayLike, margin: float = 0.0) -> NDArray[np.bool_]:
        """Say which places lie on the level face, mm; `margin` or more from all that bounds it."""
        found = self.outline.inside(x, y, by=self.rim + margin)
        for hole in self.holes:
            away = np.hypot(np.subtract(x, hole.at[0]), np.subtract(y, hole.at[1]))
            found &= away >= hole.radius + margin
        return found

    def level(self, x: float, y: float) -> float:
        """Z of the top at a place on the face or the frame, mm."""
        frame = self.frame
        return 0.0 if frame is None or self.outline.inside(x, y, by=frame.width) else frame.height

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> "Stock":
        """Build a stock from what `dataclasses.asdict` made of it, JSON's lists included."""
        given = dict(values)
        if frame := given.get("frame"):
            given["frame"] = Frame(**{**frame, "edge": frame["edge"] and Edge(**frame["edge"])})
        for name, kind in (("holes", Hole), ("keyholes", Keyhole)):
            listed = given.get(name, ())
            given[name] = tuple(kind(**{**item, "at": tuple(item["at"])}) for item in listed)
        given["work_zero"] = tuple(given.get("work_zero", (0.0, 0.0, 0.0)))
        return cls(**given)

    @classmethod
    def zeroed(
        cls, size: tuple[float, float, float], place: str, level: str = "top", **form: Any
    ) -> "Stock":
        """Set work zero at one of nine points, on the face or under the slab.

        Parameters
        ----------
        size : tuple of float
            Width, height and thickness, mm.
        place : str
            One of `PLACES`: 'near-left', 'centre', 'far' ...
        level : {'top', 'bottom'}
            The bottom of a round stock is its axis.
        **form
            The stock's other parameters.

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
        z = 0.0 if level == "top" else -(form.get("radius", 0.0) or size[2])
        return cls(*size, work_zero=(x * size[0], y * size[1], z), **form)

    def _openings(self) -> list[tuple[Place, Place, float]]:
        """Each hole and keyhole as a line with a radius: its two ends, and mm."""
        found = [(hole.at, hole.at, hole.radius) for hole in self.holes]
        for key in self.keyholes:
            found.append((key.at, (key.at[0], key.at[1] - key.travel), key.head / 2))
        return found


def _check_frame(frame: Frame, outline: Outline, thickness: float) -> None:
    if frame.width >= outline.room:
        raise InputError(
            "the frame is wider than the panel",
            expected=f"under {outline.room:g} mm",
            found=f"{frame.width:g} mm",
            where="frame",
        )
    if -frame.height > thickness - WALL:
        raise InputError(
            "the frame is sunk through the stock",
            expected=f"at most {thickness - WALL:g} mm deep",
            found=f"{-frame.height:g} mm",
            where="frame_height",
        )
    if frame.width + (frame.edge.width if frame.edge else 0.0) >= outline.room:
        raise InputError(
            "the frame's edge leaves no face", expected="a narrower frame or edge", where="frame"
        )


def _within(stock: Stock, at: Place, start: float, end: float) -> bool:
    """Say whether a place is inside the outline by more than `start`, and less than `end`, mm."""
    outline = stock.outline
    return bool(outline.inside(*at, by=start)) and not outline.inside(*at, by=end)


def _check_hole(hole: Hole, stock: Stock) -> None:
    margin, frame = hole.radius + WALL, stock.frame
    on_frame = frame is not None and _within(stock, hole.at, margin, frame.width - margin)
    if not on_frame and not _within(stock, hole.at, stock.rim + margin, stock.outline.room):
        raise InputError(
            "a hole runs over an edge of the stock",
            expected=f"{margin:g} mm or more from its axis to the "
            + ("edges of frame and face" if frame else "outline"),
            found=f"X {hole.at[0]:g} Y {hole.at[1]:g}",
            where="holes",
        )
    through = stock.thickness + (frame.height if frame and on_frame else 0.0)
    if hole.countersink and (hole.countersink - hole.diameter) / 2 >= through:
        raise InputError(
            "the countersink goes through the stock",
            expected=f"under {hole.diameter + 2 * through:g} mm",
            found=f"{hole.countersink:g} mm",
            where="countersink",
        )


def _check_keyhole(key: Keyhole, stock: Stock) -> None:
    margin = key.head / 2 + WALL
    ends = (key.at, (key.at[0], key.at[1] - key.travel))
    if not all(stock.outline.inside(x, y, by=margin) for x, y in ends):
        raise InputError(
            "a keyhole runs over the stock's side",
            expected=f"{margin:g} mm or more inside it, down to {key.travel:g} mm under its place",
            found=f"X {key.at[0]:g} Y {key.at[1]:g}",
            where="keyholes",
        )
    sunk = -min(stock.frame.height, 0.0) if stock.frame else 0.0
    if key.depth + WALL > stock.thickness - sunk:
        raise InputError(
            "the stock is too thin for keyholes",
            expected=f"{key.depth + WALL + sunk:g} mm or more",
            found=f"{stock.thickness:g} mm",
            where="thickness",
        )


def _check_apart(one: tuple[Place, Place, float], other: tuple[Place, Place, float]) -> None:
    """Refuse two openings, both upright in plan, that run into each other."""
    (x0, top0), (_, low0), r0 = one
    (x1, top1), (_, low1), r1 = other
    rise = max(low0 - top1, low1 - top0, 0.0)
    if (x0 - x1) ** 2 + rise**2 < (r0 + r1 + WALL) ** 2:
        raise InputError(
            "two holes run into each other",
            expected=f"{r0 + r1 + WALL:g} mm from axis to axis, or more",
            found=f"X {x0:g} Y {top0:g} and X {x1:g} Y {top1:g}",
            where="holes",
        )
