"""The kinds of line that can be drawn, the stronger ones first."""

from collections.abc import Callable
from dataclasses import dataclass

from relieffab.layers.lines import contours, highlights, ridges
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.names import NAMES, PRINCIPAL
from relieffab.layers.lines.surface import Surface


@dataclass(frozen=True)
class Kind:
    """One kind of line.

    Parameters
    ----------
    name : str
    principal : bool
        Whether it bounds a form, or only tells how it bends.
    of_surface : callable, optional
        From a surface to all its lines of this kind, seen or not; not given
        where the lines lie along the mesh's own edges, or come from the mask.
    """

    name: str
    principal: bool
    of_surface: Callable[[Surface], Chains] | None = None


_FINDERS = {
    "contour": contours.contours,
    "suggestive": contours.suggestive,
    "ridge": ridges.ridges,
    "valley": ridges.valleys,
    "apparent-ridge": ridges.apparent_ridges,
    "suggestive-highlight": highlights.suggestive_highlights,
    "principal-highlight": highlights.principal_highlights,
}

KINDS = tuple(Kind(name, name in PRINCIPAL, _FINDERS.get(name)) for name in NAMES)
"""All kinds, the stronger ones first."""
