"""Marks cut to the inside of other paths, and areas that overlap made one."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from relieffab.layers.art.art import Mark, Ring

FINE = 2**30
"""Steps of Clipper's whole numbers to the farthest coordinate."""


def clipped(mark: Mark, region: Sequence[Mark]) -> list[Mark]:
    """Cut a mark to a region; its stroke stops where it leaves, with no stroke along the cut.

    Parameters
    ----------
    mark : Mark
    region : sequence of Mark
        Filled paths; what any of them covers is inside.

    Returns
    -------
    list of Mark
        The area and the lines that are left, in that order; none where nothing is.
    """
    scale = _scale((mark, *region))
    inside = _union(region, scale)
    left = []
    if mark.fill is not None:
        rings = _areas(mark, inside, scale)
        left += [Mark(rings, fill="nonzero", paper=mark.paper)] if rings else []
    if mark.width is not None:
        rings = _lines(mark.rings, inside, scale)
        left += [replace(mark, rings=rings, fill=None, paper=False)] if rings else []
    return left


def joined(marks: Sequence[Mark]) -> list[Mark]:
    """Make areas that overlap the one before them one with it: no outline runs through another.

    Parameters
    ----------
    marks : sequence of Mark
        Filled, without strokes.
    """
    out: list[Mark] = []
    for mark in marks:
        if out and clipped(mark, out[-1:]):
            scale = _scale((out[-1], mark))
            paths = _union((out.pop(), mark), scale)
            rings = tuple(Ring(np.array(path) / scale, closed=True) for path in paths)
            out.append(Mark(rings, fill="nonzero"))
        else:
            out.append(mark)
    return out


def _scale(marks: Sequence[Mark]) -> float:
    """Clipper's steps to a unit of the page."""
    far = [float(np.abs(ring.points).max()) for mark in marks for ring in mark.rings]
    return FINE / max(*far, 1e-300) if far else 1.0


def _rule(mark: Mark) -> Any:
    import pyclipper

    return pyclipper.PFT_EVENODD if mark.fill == "evenodd" else pyclipper.PFT_NONZERO


def _add(clipper: Any, paths: Iterable[Any], kind: int, *, closed: bool) -> bool:
    """Hand paths over; whether there were any but points and lines that enclose nothing."""
    import pyclipper

    added = False
    for path in paths:
        try:
            added = clipper.AddPath(path, kind, closed) or added
        except pyclipper.ClipperException:  # it encloses nothing
            continue
    return added


def _whole(rings: Iterable[Ring], scale: float) -> list[Any]:
    return [np.rint(ring.points * scale).astype(np.int64).tolist() for ring in rings]


def _union(region: Sequence[Mark], scale: float) -> list[Any]:
    import pyclipper

    union: list[Any] = []
    for part in region:
        clipper = pyclipper.Pyclipper()
        some = _add(clipper, _whole(part.rings, scale), pyclipper.PT_SUBJECT, closed=True)
        rule = _rule(part)
        union += clipper.Execute(pyclipper.CT_UNION, rule, rule) if some else []
    clipper = pyclipper.Pyclipper()
    if not _add(clipper, union, pyclipper.PT_SUBJECT, closed=True):
        return []
    rule = pyclipper.PFT_NONZERO
    return list(clipper.Execute(pyclipper.CT_UNION, rule, rule))


def _areas(mark: Mark, inside: list[Any], scale: float) -> tuple[Ring, ...]:
    import pyclipper

    clipper = pyclipper.Pyclipper()
    kept = _add(clipper, _whole(mark.rings, scale), pyclipper.PT_SUBJECT, closed=True)
    if not _add(clipper, inside, pyclipper.PT_CLIP, closed=True) or not kept:
        return ()
    paths = clipper.Execute(pyclipper.CT_INTERSECTION, _rule(mark), pyclipper.PFT_NONZERO)
    return tuple(Ring(np.array(path) / scale, closed=True) for path in paths)


def _lines(rings: Iterable[Ring], inside: list[Any], scale: float) -> tuple[Ring, ...]:
    import pyclipper

    clipper = pyclipper.Pyclipper()
    open_rings = (
        replace(ring, points=np.concatenate([ring.points, ring.points[:1]]))
        if ring.closed
        else ring
        for ring in rings
    )
    kept = _add(clipper, _whole(open_rings, scale), pyclipper.PT_SUBJECT, closed=False)
    if not _add(clipper, inside, pyclipper.PT_CLIP, closed=True) or not kept:
        return ()
    nonzero = pyclipper.PFT_NONZERO
    tree = clipper.Execute2(pyclipper.CT_INTERSECTION, nonzero, nonzero)
    paths = pyclipper.OpenPathsFromPolyTree(tree)
    return tuple(Ring(np.array(path) / scale, closed=False) for path in paths if len(path) > 1)
