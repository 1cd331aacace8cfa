"""The kinds of line that can be drawn, the stronger ones first."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from relieffab.errors import InputError, suggest
from relieffab.layers.lines import contours, highlights, ridges
from relieffab.layers.lines.chains import Chains
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


KINDS = (
    Kind("outline", principal=True),
    Kind("contour", principal=True, of_surface=contours.contours),
    Kind("boundary", principal=True),
    Kind("crease", principal=True),
    Kind("suggestive", principal=False, of_surface=contours.suggestive),
    Kind("ridge", principal=False, of_surface=ridges.ridges),
    Kind("valley", principal=False, of_surface=ridges.valleys),
    Kind("apparent-ridge", principal=False, of_surface=ridges.apparent_ridges),
    Kind("suggestive-highlight", principal=False, of_surface=highlights.suggestive_highlights),
    Kind("principal-highlight", principal=False, of_surface=highlights.principal_highlights),
)
NAMES = tuple(kind.name for kind in KINDS)
USUAL = NAMES[:5]
PRINCIPAL = frozenset(kind.name for kind in KINDS if kind.principal)


def chosen(names: Iterable[str]) -> tuple[str, ...]:
    """Return the kinds named, each once, the stronger ones first.

    Raises
    ------
    InputError
        If none is named, or one that is not a kind of line.
    """
    names = tuple(names)
    for name in names:
        if name not in NAMES:
            raise InputError(
                "there is no such kind of line", found=repr(name), hint=suggest(name, NAMES)
            )
    if not names:
        raise InputError("a drawing needs a kind of line", expected="some of " + " ".join(NAMES))
    return tuple(name for name in NAMES if name in names)
