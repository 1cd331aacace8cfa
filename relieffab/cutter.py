"""Cutter: every tool of revolution the toolkit knows, as one family of profiles."""

from dataclasses import dataclass
from math import cos, inf, radians, sin, tan
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError, suggest

Shape = Literal["flat", "ball", "bull", "vee", "tapered ball"]

_OWN = {
    "angle": ("vee", "tapered ball"),
    "tip_diameter": ("vee", "tapered ball"),
    "corner_radius": ("bull",),
}


@dataclass(frozen=True)
class Cutter:
    """A cutter and how hard it may be pushed in softwood.

    Seen from the side every shape is a flat of radius `flat_radius`, then an arc
    of radius `tip_radius`, then a cone (or cylinder) up to `radius`.

    Parameters
    ----------
    name, title : str
        Key in machines/cutters, and words for people.
    shape : {'flat', 'ball', 'bull', 'vee', 'tapered ball'}
    diameter : float
        Largest cutting diameter, mm.
    flute_length : float
        How deep it may go below the stock's top, mm.
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

    def __post_init__(self) -> None:
        where = f"cutter {self.name}"
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
        if self.shape in ("vee", "tapered ball") and not 0 < self.angle < 180:
            raise InputError(
                "a cone needs its included angle",
                expected="angle between 0 and 180 degrees",
                found=f"{self.angle}",
                where=where,
            )
        if self.shape == "tapered ball" and not 0 < self.tip_diameter <= self.diameter:
            raise InputError(
                "a tapered ball needs the diameter of its ball",
                expected=f"tip_diameter up to {self.diameter} mm",
                found=f"{self.tip_diameter}",
                where=where,
            )
        if self.shape == "vee" and not 0 <= self.tip_diameter < self.diameter:
            raise InputError(
                "the flat tip of a vee is narrower than the cutter",
                expected=f"tip_diameter under {self.diameter} mm",
                found=f"{self.tip_diameter}",
                where=where,
            )
        if self.shape == "bull" and not 0 < self.corner_radius < self.diameter / 2:
            raise InputError(
                "a bull nose needs a corner radius smaller than its radius",
                expected=f"corner_radius under {self.diameter / 2} mm",
                found=f"{self.corner_radius}",
                where=where,
            )

    @property
    def radius(self) -> float:
        """Largest cutting radius, mm."""
        return self.diameter / 2

    @property
    def flat_radius(self) -> float:
        """Radius of the flat under the cutter, mm."""
        if self.shape == "flat":
            return self.radius
        if self.shape == "bull":
            return self.radius - self.corner_radius
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
        }[self.shape]

    @property
    def flank(self) -> float:
        """Slope of the cone, dz/dr; infinite for a cylinder."""
        return 1 / tan(radians(self.angle / 2)) if self.angle else inf

    @property
    def arc_end(self) -> float:
        """Radius at which the arc gives way to the flank, mm."""
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
        half = radians(self.angle / 2)
        across = np.clip(away - self.flat_radius, 0.0, self.arc_end - self.flat_radius)
        height = self.tip_radius - np.sqrt(np.maximum(self.tip_radius**2 - across**2, 0.0))
        if self.angle:
            arc_height = self.tip_radius * (1 - sin(half))
            cone = arc_height + (away - self.arc_end) * self.flank
            height = np.where(away > self.arc_end, cone, height)
        return np.where(away > self.radius * (1 + 1e-12), inf, height)
