"""What a slab may have beside its face: a frame, holes for screws, keyholes to hang it by."""

from dataclasses import dataclass
from itertools import product
from typing import Literal

from relieffab.errors import InputError

Kind = Literal["rectangle", "round", "arched"]  # of outline
Place = tuple[float, float]

_ALONG = {"left": 0.0, "": 0.5, "right": 1.0}
_ACROSS = {"near": 0.0, "": 0.5, "far": 1.0}
PLACES = {
    "-".join(filter(None, (y, x))) or "centre": (_ALONG[x], _ACROSS[y])
    for y, x in product(_ACROSS, _ALONG)
}
"""Nine points of a slab by name, as shares of its width and height."""
LEVELS = ("top", "bottom")


@dataclass(frozen=True)
class Edge:
    """How an edge is broken.

    Parameters
    ----------
    kind : {'chamfer', 'fillet'}
    width : float
        Of the chamfer at 45 degrees, or the fillet's radius, mm.
    """

    kind: Literal["chamfer", "fillet"]
    width: float


@dataclass(frozen=True)
class Frame:
    """A strip along the outline, above the face or below it.

    Parameters
    ----------
    width : float
        mm.
    height : float
        Over the face, mm; less than 0 is sunk.
    edge : Edge or None
        Of the higher of the two levels.
    """

    width: float
    height: float
    edge: Edge | None = None

    def __post_init__(self) -> None:
        if self.height == 0 or self.width <= 0:
            raise InputError(
                "that is no frame",
                expected="a width over 0 mm, and a height over or under 0 mm",
                found=f"{self.width:g} mm wide, {self.height:g} mm high",
                where="frame",
            )
        most = min(abs(self.height), self.width / 2)
        if self.edge and self.edge.width >= most:
            raise InputError(
                f"the frame has no room for such a {self.edge.kind}",
                expected=f"under {most:g} mm",
                found=f"{self.edge.width:g} mm",
                where="frame_edge",
            )


@dataclass(frozen=True)
class Hole:
    """A hole through the stock, for a screw.

    Parameters
    ----------
    at : tuple of float
        X and Y of its axis, mm.
    diameter : float
        mm.
    countersink : float or None
        Diameter at the top of a cone of 90 degrees, mm.
    """

    at: Place
    diameter: float
    countersink: float | None = None

    def __post_init__(self) -> None:
        if self.countersink is not None and self.countersink <= self.diameter:
            raise InputError(
                "the countersink is no wider than its hole",
                expected=f"over {self.diameter:g} mm",
                found=f"{self.countersink:g} mm",
                where="countersink",
            )

    @property
    def radius(self) -> float:
        """Largest radius, mm."""
        return (self.countersink or self.diameter) / 2


@dataclass(frozen=True)
class Keyhole:
    """A slot in the back that takes the head of a screw, and hangs on its shank.

    Parameters
    ----------
    at : tuple of float
        X and Y of where the screw comes to rest, mm; the head goes in below it.
    head, neck : float
        Diameters, mm.
    travel : float
        From where the head goes in to where it rests, mm.
    lip, cavity : float
        Depth of the neck's slot from the back, and of the head's beyond it, mm.
    """

    at: Place
    head: float = 9.0
    neck: float = 4.5
    travel: float = 10.0
    lip: float = 2.0
    cavity: float = 3.5

    @property
    def depth(self) -> float:
        """How far it reaches into the back, mm."""
        return self.lip + self.cavity
