"""Style: which marks a relief bears; Marks: where they are, for the program that cuts them."""

from dataclasses import dataclass, replace
from math import ceil

import numpy as np
from numpy.typing import NDArray

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.errors import InputError, suggest
from relieffab.relief.model import Relief
from relieffab.relief.style.chisels import CHISELS, PECK, Chisel
from relieffab.relief.style.names import GROUNDS, NONE, PECKED, PLAIN, STYLES

Floats = NDArray[np.float64]

FINEST = 2.5  # pixels across a mark, under which it is only a row of dots


@dataclass(frozen=True)
class Style:
    """The marks of a chisel, on the figure and on the ground around it.

    Parameters
    ----------
    marks : str
        On the figure: 'none', or a chisel of `CHISELS`.
    spacing, depth : float or None
        Between marks, and of a mark below the surface, mm; the chisel's own if None.
    direction : float or None
        Of the strokes, from X towards Y, degrees; as the form goes if None.
    cutter : Cutter or None
        That cuts the marks: its tip is their cross-section; the chisel's own if None.
    ground : str
        'plain' or 'pecked'.
    """

    marks: str = NONE
    spacing: float | None = None
    depth: float | None = None
    direction: float | None = None
    cutter: Cutter | None = None
    ground: str = PLAIN

    def __post_init__(self) -> None:
        for name, names in ((self.marks, STYLES), (self.ground, GROUNDS)):
            if name not in names:
                raise InputError(
                    "there is no style of that name",
                    expected=", ".join(names),
                    found=str(name),
                    hint=suggest(str(name), names),
                )
        for name in ("spacing", "depth"):
            value = getattr(self, name)
            if value is not None and not 0 < value < np.inf:
                raise InputError(
                    f"the marks' {name} cannot be {value:g} mm", expected="more than 0 mm"
                )
        if self.direction is not None and not np.isfinite(self.direction):
            raise InputError("the marks' direction is not a number", found=f"{self.direction}")

    @property
    def plain(self) -> bool:
        """Whether there are no marks at all."""
        return self.marks == NONE and self.ground == PLAIN

    @property
    def pecked(self) -> bool:
        """Whether the ground around the figure is pecked."""
        return self.ground == PECKED

    @property
    def headroom(self) -> float:
        """How much of the relief's depth the marks on the figure take, mm."""
        return 0.0 if self.marks == NONE else self.chisel.depth

    @property
    def chisel(self) -> Chisel:
        """The chisel, with spacing and depth as they were asked for."""
        own = CHISELS.get(self.marks, PECK)
        return replace(
            own,
            spacing=own.spacing if self.spacing is None else self.spacing,
            depth=own.depth if self.depth is None else self.depth,
        )

    @property
    def tool(self) -> Cutter:
        """The cutter that cuts the marks."""
        return self.cutter or profiles.cutter(self.chisel.cutter)

    def check(self, depth: float, pitch: float) -> None:
        """Refuse marks that the relief cannot hold or its pixels cannot show.

        Parameters
        ----------
        depth : float
            Of the relief, marks included, mm.
        pitch : float
            mm.

        Raises
        ------
        InputError
            Saying what would fit.
        """
        chisel, tool = self.chisel, self.tool
        if chisel.depth > depth / 2:
            raise InputError(
                "the marks take too much of the relief's depth",
                expected=f"at most half of its {depth:g} mm",
                found=f"{chisel.depth:g} mm",
                hint="a smaller --mark-depth or a larger --depth",
            )
        if chisel.spacing < FINEST * pitch:
            raise InputError(
                "the marks are closer together than the relief's pixels can show",
                expected=f"{_rounded_up(FINEST * pitch)} mm or more",
                found=f"{chisel.spacing:g} mm",
                hint="a finer --resolution or a larger --mark-spacing",
            )
        width = mark_width(tool, chisel.depth)
        if width < FINEST * pitch:
            raise InputError(
                "the marks are finer than the relief's pixels can show",
                expected=f"{_rounded_up(FINEST * pitch)} mm or more across",
                found=f"{width:.2g} mm, cut {chisel.depth:g} mm deep by {tool.name}",
                hint="a finer --resolution, a larger --mark-depth or a wider --mark-cutter",
            )


def mark_width(cutter: Cutter, depth: float) -> float:
    """Width of the mark that a cutter leaves so deep in level ground, mm."""
    radii = np.linspace(0.0, cutter.radius, 4096)
    return 2.0 * float(radii[cutter.profile(radii) <= depth].max())


@dataclass(frozen=True, eq=False)
class Marks:
    """Marks as a program cuts them.

    Parameters
    ----------
    cutter : Cutter
    smooth : Relief
        The relief before the marks.
    lines : tuple of (k, 2) ndarray
        Ways of the cutter's axis, X and Y, mm; a peck is a line that ends where it starts.
    """

    cutter: Cutter
    smooth: Relief
    lines: tuple[Floats, ...]


def _rounded_up(length: float) -> str:
    """Write a least length so that what is written is enough."""
    return f"{ceil(100 * length - 1e-6) / 100:g}"
