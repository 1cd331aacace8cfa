"""Outlines of a panel seen from above, and how far inside one a place lies."""

from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError, suggest
from relieffab.fittings import Kind

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Outline:
    """The outline of a panel, its near left corner at X0 Y0.

    Parameters
    ----------
    kind : {'rectangle', 'round', 'arched'}
        Round is an ellipse as wide and high as asked; arched has a half circle
        for its far end.
    width, height : float
        X and Y, mm.
    corner : float
        Radius of the corners, mm; an arch has them at its near end.
    """

    kind: Kind
    width: float
    height: float
    corner: float = 0.0

    def __post_init__(self) -> None:
        if self.kind not in get_args(Kind):
            hint = suggest(self.kind, get_args(Kind))
            raise InputError("there is no outline of that name", found=self.kind, hint=hint)
        if self.kind == "arched" and self.height <= self.width / 2:
            raise InputError(
                "the panel is too low for an arch",
                expected=f"a height over half its width, {self.width / 2:g} mm",
                found=f"{self.height:g} mm",
                where="size",
            )
        if self.kind == "round" and self.corner:
            raise InputError(
                "a round panel has no corners", found=f"{self.corner:g} mm", where="corner"
            )
        straight = self.height - (self.width / 2 if self.kind == "arched" else 0.0)
        most = min(self.width / 2, straight / (1 if self.kind == "arched" else 2))
        if not 0 <= self.corner < most:
            raise InputError(
                "the panel has no room for such corners",
                expected=f"0 or more, under {most:g} mm",
                found=f"{self.corner:g} mm",
                where="corner",
            )

    @property
    def plain(self) -> bool:
        """Whether it is a rectangle with sharp corners."""
        return self.kind == "rectangle" and self.corner == 0

    @property
    def room(self) -> float:
        """Inset at which it would lose its form, mm: nothing, or no arch, is left."""
        half = min(self.width, self.height) / 2
        return min(half, self.height - self.width / 2) if self.kind == "arched" else half

    def inset(self, by: float) -> "Outline":
        """Draw the outline further in; its near left corner moves to X0 Y0.

        Parallel to the given one but for an ellipse, which is another ellipse,
        nearer by `by` along its axes and slightly less between them.
        """
        corner = max(self.corner - by, 0.0) if self.corner else 0.0
        return Outline(self.kind, self.width - 2 * by, self.height - 2 * by, corner)

    def inside(self, x: ArrayLike, y: ArrayLike, by: float = 0.0) -> NDArray[np.bool_]:
        """Say which places lie inside the outline, or inside it drawn further in.

        Parameters
        ----------
        x, y : array_like
            mm.
        by : float, optional
            How much further in, mm; less than 0 is further out.  From `room` on there
            is no inside.
        """
        if by >= self.room:
            return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)), bool)
        inner = self.inset(by)
        dx = np.abs(np.asarray(x, float) - self.width / 2)
        y = np.asarray(y, float) - by
        half_x, half_y = inner.width / 2, inner.height / 2
        if self.kind == "round":
            return np.asarray((dx / half_x) ** 2 + ((y - half_y) / half_y) ** 2 <= 1.0)
        spring = inner.height - half_x if self.kind == "arched" else inner.height
        arch = np.hypot(dx, np.maximum(y - spring, 0.0)) <= half_x
        box = (dx <= half_x) & (y >= 0) & (y <= inner.height)
        low = y if self.kind == "arched" else np.minimum(y, inner.height - y)
        r = inner.corner
        rounded = np.hypot(np.maximum(dx - half_x + r, 0.0), np.maximum(r - low, 0.0)) <= r
        cornered = (dx <= half_x - r) | (low >= r) | rounded
        return np.asarray(box & cornered & (arch if self.kind == "arched" else True))

    def polygon(self, *, by: float = 0.0, error: float = 0.01) -> Floats:
        """Walk round the outline, counter-clockwise.

        Parameters
        ----------
        by : float, optional
            How much further in, mm.
        error : float, optional
            Largest distance of a chord from its arc, mm.

        Returns
        -------
        (n, 2) ndarray
            X and Y on the panel, mm.
        """
        inner = self.inset(by)
        w, h, r = inner.width, inner.height, inner.corner
        if inner.kind == "round":
            found = _arc((w / 2, h / 2), (w / 2, h / 2), 0.0, 360.0, error)[:-1]
        elif inner.kind == "arched":
            far = _arc((w / 2, h - w / 2), (w / 2, w / 2), 0.0, 180.0, error)
            found = np.concatenate([*_corners(w, h, r, error)[:2], far])
        else:
            found = np.concatenate(_corners(w, h, r, error))
        return found + by


def _arc(
    middle: tuple[float, float], radii: tuple[float, float], first: float, last: float, error: float
) -> Floats:
    """Walk along an arc of an ellipse, both ends included; angles in degrees."""
    step = 2 * np.arccos(1 - min(error / max(radii), 0.5))
    count = int(np.ceil(np.radians(last - first) / step))
    t = np.radians(np.linspace(first, last, count + 1))
    return np.stack([np.cos(t), np.sin(t)], axis=1) * radii + middle


def _corners(w: float, h: float, r: float, error: float) -> list[Floats]:
    """Walk round the four corners of a rectangle, from the near left one."""
    places = [(0.0, 0.0, r, r), (w, 0.0, w - r, r), (w, h, w - r, h - r), (0.0, h, r, h - r)]
    return [
        _arc((mx, my), (r, r), 180 + 90 * k, 270 + 90 * k, error) if r else np.array([[x, y]])
        for k, (x, y, mx, my) in enumerate(places)
    ]
