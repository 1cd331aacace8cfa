"""Cutter: every tool of revolution the toolkit knows, as one family of profiles."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import cos, inf, radians, sin, tan
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError, suggest

Shape = Literal["flat", "ball", "bull", "vee", "tapered ball", "form"]

_OWN = {
    "angle": ("vee", "tapered ball"),
    "tip_diameter": ("vee", "tapered ball"),
    "corner_radius": ("bull",),
    "points": ("form",),
}


@dataclass(frozen=True)
class Cutter:
    """A cutter and how hard it may be pushed in softwood.

    Seen from the side every shape but a form is a flat of radius `flat_radius`, then
    an arc of radius `tip_radius`, then a cone (or cylinder) up to `radius`.

    Parameters
    ----------
    name, title : str
        Key in machines/cutters, and words for people.
    shape : {'flat', 'ball', 'bull', 'vee', 'tapered ball', 'form'}
    diameter : float
        Largest cutting diameter, mm.
    flute_length : float
        How deep it may go below the stock's top, mm: there the shank begins.
    stepdown : float
        Deepest single pass, mm.
    feed, plunge : float
        mm/min, sideways and downwards.
    rpm : float
        Spindle speed, revolutions per minute.
    tip_diameter : float
        Of the ball of a tapered ball, or the flat of a vee, mm.
    corner_radius : float
        Of a bull nose, mm.
    angle : float
        Included angle of the cone of a vee or a tapered ball, degrees.
    points : tuple of (float, float)
        Profile of a form cutter: distance from the axis and height above the tip, mm,
        from (0, 0) to the radius, convex.
    shank_diameter : float
        Above the flutes, mm; 0 where it is as wide as the cutter.
    stickout : float
        How far the cutter stands out of its collet, mm; 0 where that is not known.
    """

    name: str
    shape: Shape
    diameter: float
    flute_length: float
    stepdown: float
    feed: float
    plunge: float
    rpm: float
    tip_diameter: float = 0.0
    corner_radius: float = 0.0
    angle: float = 0.0
    title: str = ""
    source: str = ""
    points: tuple[tuple[float, float], ...] = ()
    shank_diameter: float = 0.0
    stickout: float = 0.0

    def __post_init__(self) -> None:
        where = f"cutter {self.name}"
        object.__setattr__(self, "points", tuple((float(r), float(z)) for r, z in self.points))
        if self.shape not in get_args(Shape):
            raise InputError(
                "unknown cutter shape",
                found=self.shape,
                where=where,
                hint=suggest(self.shape, get_args(Shape)),
            )
        for name in ("diameter", "flute_length", "stepdown", "feed", "plunge", "rpm"):
            value = getattr(self, name)
            if not 0 < value < inf:
                raise InputError(f"{name} cannot be {value}", expected="more than 0", where=where)
        for name, shapes in _OWN.items():
            if getattr(self, name) and self.shape not in shapes:
                raise InputError(
                    f"a {self.shape} cutter has no {name}",
                    expected=f"{name} only for: {', '.join(shapes)}",
                    found=f"{getattr(self, name)}",
                    where=where,
                )
        for fits, what, expected, found in self._demands():
            if not fits:
                raise InputError(what, expected=expected, found=f"{found}", where=where)

    def _demands(self) -> Iterator[tuple[bool, str, str, object]]:
        """List what each shape asks of its own measures."""
        if self.shape in ("vee", "tapered ball"):
            yield (
                0 < self.angle < 180,
                "a cone needs its included angle",
                "angle between 0 and 180 degrees",
                self.angle,
            )
        if self.shape == "tapered ball":
            yield (
                0 < self.tip_diameter <= self.diameter,
                "a tapered ball needs the diameter of its ball",
                f"tip_diameter up to {self.diameter} mm",
                self.tip_diameter,
            )
        if self.shape == "vee":
            yield (
                0 <= self.tip_diameter < self.diameter,
                "the flat tip of a vee is narrower than the cutter",
                f"tip_diameter under {self.diameter} mm",
                self.tip_diameter,
            )
        if self.shape == "bull":
            yield (
                0 < self.corner_radius < self.diameter / 2,
                "a bull nose needs a corner radius smaller than its radius",
                f"corner_radius under {self.diameter / 2} mm",
                self.corner_radius,
            )
        if self.shape == "form":
            yield (
                is_profile(self.points, self.radius),
                "a form cutter needs a convex profile",
                f"points from (0, 0) outwards to a radius of {self.radius} mm, each stretch "
                "steeper than the one before",
                self.points,
            )
        yield (
            self.shank_diameter == 0 or 0 < self.shank_diameter < inf,
            "the shank has no such diameter",
            "more than 0 mm, or 0 for one as wide as the cutter",
            self.shank_diameter,
        )
        yield (
            self.stickout == 0 or self.flute_length <= self.stickout < inf,
            "the flutes reach into the collet",
            f"a stick-out of at least the flutes' {self.flute_length} mm",
            self.stickout,
        )

    @property
    def radius(self) -> float:
        """Largest cutting radius, mm."""
        return self.diameter / 2

    @property
    def shank_radius(self) -> float:
        """Radius above the flutes, mm."""
        return self.shank_diameter / 2 or self.radius

    @property
    def flat_radius(self) -> float:
        """Radius of the flat under the cutter, mm."""
        if self.shape == "flat":
            return self.radius
        if self.shape == "bull":
            return self.radius - self.corner_radius
        if self.shape == "form":
            return max(r for r, z in self.points if z == 0)
        return self.tip_diameter / 2 if self.shape == "vee" else 0.0

    @property
    def tip_radius(self) -> float:
        """Radius of the arc between flat and flank, mm."""
        return {
            "flat": 0.0,
            "ball": self.radius,
            "bull": self.corner_radius,
            "vee": 0.0,
            "tapered ball": self.tip_diameter / 2,
            "form": 0.0,
        }[self.shape]

    @property
    def flank(self) -> float:
        """Slope of the cone, dz/dr; infinite for a cylinder.

        Raises
        ------
        InputError
            For a form cutter, whose flank has more than one slope.
        """
        if self.shape == "form":
            raise InputError(
                "a form cutter has no one flank",
                where=f"cutter {self.name}",
                found=f"{self.points}",
            )
        return 1 / tan(radians(self.angle / 2)) if self.angle else inf

    @property
    def arc_end(self) -> float:
        """Radius at which the arc gives way to the flank, mm; of a form, its radius."""
        if self.shape == "form":
            return self.radius
        half = radians(self.angle / 2)
        return self.flat_radius + self.tip_radius * cos(half)

    def profile(self, r: ArrayLike) -> NDArray[np.float64]:
        """Height of the cutter's surface above its tip.

        Parameters
        ----------
        r : array_like
            Distance from the axis, mm.

        Returns
        -------
        ndarray
            Height in mm, infinite beyond `radius`.
        """
        away = np.abs(np.asarray(r, dtype=float))
        if self.shape == "form":
            r_of, z_of = np.transpose(self.points)
            return np.asarray(np.interp(away, r_of, z_of, right=inf), dtype=np.float64)
        half = radians(self.angle / 2)
        across = np.clip(away - self.flat_radius, 0.0, self.arc_end - self.flat_radius)
        height = self.tip_radius - np.sqrt(np.maximum(self.tip_radius**2 - across**2, 0.0))
        if self.angle:
            arc_height = self.tip_radius * (1 - sin(half))
            cone = arc_height + (away - self.arc_end) * self.flank
            height = np.where(away > self.arc_end, cone, height)
        return np.where(away > self.radius * (1 + 1e-12), inf, height)


def is_profile(points: Sequence[tuple[float, float]], radius: float) -> bool:
    """Whether points are a convex profile from the tip to a radius."""
    r, z = np.transpose(points) if len(points) > 1 else np.zeros((2, 1))
    if not (np.isfinite([r, z]).all() and len(r) > 1 and r[0] == z[0] == 0):
        return False
    if not (np.diff(r) > 0).all() or abs(r[-1] - radius) > 1e-9:
        return False
    slopes = np.diff(z) / np.diff(r)
    return bool(slopes[0] >= 0 and (np.diff(slopes) > -1e-12).all())
