"""The uncut stock as a CAD solid: the one place that knows cadquery.

cadquery takes three seconds to load and half a gigabyte to hold: `blank` has it
do its work in a process of its own.
"""

from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from relieffab.errors import InputError, RelieffabError
from relieffab.fittings import Edge, Hole, Keyhole
from relieffab.outline import Outline
from relieffab.panel.export import beside
from relieffab.panel.model import Floats, Ints
from relieffab.round import Curved, Round
from relieffab.stock import Stock

BEYOND = 1.0  # mm that a cutting solid reaches past what it cuts
# Of the triangles that stand for curved sides: distance, mm, and turn, radians.
CHORD, TURN = 0.01, 0.3
DIGITS = 7  # of a mm: nearer corners are the same


class CadUnavailableError(RelieffabError):
    """The CAD library cannot be loaded here; all else works without it."""


def cadquery() -> ModuleType:
    """Load cadquery, which takes seconds and asks for the system's OpenGL.

    Raises
    ------
    CadUnavailableError
        If it, or a system library it needs, is not there.
    """
    try:
        import cadquery
    except ImportError as error:
        missing = isinstance(error, ModuleNotFoundError) and error.name == "cadquery"
        raise CadUnavailableError(
            "the stock cannot be drawn without cadquery",
            found=str(error),
            hint="pip install cadquery" if missing else "apt install libgl1 libx11-6",
        ) from error
    return cadquery  # type: ignore[no-any-return]


def _prism(cq: Any, outline: Outline, by: float, low: float, high: float) -> Any:
    """Raise an outline, drawn further in by `by`, from one level to another."""
    inner = outline.inset(by)
    w, h = inner.width, inner.height
    plane = cq.Workplane("XY", origin=(by, by, low))
    if inner.kind == "round":
        plan = plane.center(w / 2, h / 2).ellipse(w / 2, h / 2)
    elif inner.kind == "arched":
        spring = h - w / 2
        plan = plane.lineTo(w, 0).lineTo(w, spring)
        plan = plan.threePointArc((w / 2, h), (0, spring)).close()
    else:
        plan = plane.rect(w, h, centered=False)
    solid = plan.extrude(high - low)
    if inner.corner:
        sides = solid.faces("<Y") if inner.kind == "arched" else solid
        solid = sides.edges("|Z").fillet(inner.corner)
    return solid


def _kernel_errors() -> tuple[type[Exception], ...]:
    """List what the CAD kernel raises: a flat lot of classes without a common base."""
    from OCP import Standard, StdFail

    found = (kind for module in (Standard, StdFail) for kind in vars(module).values())
    errors = [kind for kind in found if isinstance(kind, type) and issubclass(kind, Exception)]
    return (*errors, ValueError)


def _broken(solid: Any, edge: Edge | None) -> Any:
    """Break the edges of a solid's top.

    Raises
    ------
    InputError
        If the CAD kernel cannot, or what it gives is no solid.
    """
    if edge is None:
        return solid
    edges = solid.faces(">Z").edges()
    try:
        broken = edges.chamfer(edge.width) if edge.kind == "chamfer" else edges.fillet(edge.width)
    except _kernel_errors() as fault:
        raise _refused(edge) from fault
    if not broken.val().isValid():  # a chamfer round a corner of less than its width may be none
        raise _refused(edge)
    return broken


def _refused(edge: Edge) -> InputError:
    return InputError(
        f"the CAD kernel cannot give the frame that {edge.kind}",
        found=f"{edge.width:g} mm",
        where="frame_edge",
        hint="a slightly smaller one, or other corners",
    )


def _hole(cq: Any, hole: Hole, top: float, bottom: float) -> Any:
    """Give what is drilled: from above its top to below the back."""
    r, rim = hole.diameter / 2, hole.radius
    points = [(0, bottom - BEYOND), (r, bottom - BEYOND), (r, top - (rim - r)), (rim, top)]
    points += [(rim, top + BEYOND), (0, top + BEYOND)]
    profile = cq.Workplane("XZ").polyline(list(dict.fromkeys(points))).close()
    return profile.revolve(360, (0, 0), (0, 1)).translate((*hole.at, 0))


def _keyhole(cq: Any, key: Keyhole, bottom: float) -> Any:
    """Give what is milled from the back: the head's way in, the neck's slot, the head's slot."""
    x, y = key.at
    way_in = cq.Workplane("XY", origin=(x, y - key.travel, bottom - BEYOND))
    solid = way_in.circle(key.head / 2).extrude(BEYOND + key.depth)
    for width, low, high in (
        (key.neck, bottom - BEYOND, bottom + key.depth),
        (key.head, bottom + key.lip, bottom + key.depth),
    ):
        plane = cq.Workplane("XY", origin=(x, y - key.travel / 2, low))
        slot = plane.slot2D(key.travel + width, width, 90).extrude(high - low)
        solid = solid.union(slot)
    return solid


def frame_solid(stock: Stock) -> Any:
    """Give the frame alone: what stands on the face, or lies beside it under its level.

    Returns
    -------
    cadquery.Workplane or None
        None without a frame.
    """
    cq, frame, outline = cadquery(), stock.frame, stock.outline
    if frame is None:
        return None
    low, high = sorted((0.0, frame.height))
    strip = _prism(cq, outline, 0.0, low, high)
    if frame.height > 0:
        opening = _prism(cq, outline, frame.width, low - BEYOND, high + BEYOND)
        return _broken(strip.cut(opening), frame.edge)
    return strip.cut(_broken(_prism(cq, outline, frame.width, low, high), frame.edge))


def stock_solid(stock: Stock, frame: Any = None) -> Any:
    """Draw the stock: its face at Z0.

    Parameters
    ----------
    stock : Stock
    frame : cadquery.Workplane, optional
        From `frame_solid`, where there is one.

    Returns
    -------
    cadquery.Workplane
    """
    cq, outline, bottom = cadquery(), stock.outline, -stock.thickness
    solid = _prism(cq, outline, 0.0, bottom, 0.0)
    if stock.frame is not None:
        solid = solid.union(frame) if stock.frame.height > 0 else solid.cut(frame)
    for hole in stock.holes:
        solid = solid.cut(_hole(cq, hole, stock.level(*hole.at), bottom))
    for key in stock.keyholes:
        solid = solid.cut(_keyhole(cq, key, bottom))
    return solid


def bent_solid(stock: Round | Curved) -> Any:
    """Draw a round stock or a curved board, placed as `make_round` places what is carved of it.

    Parameters
    ----------
    stock : Round or Curved

    Returns
    -------
    cadquery.Workplane
    """
    cq = cadquery()
    if isinstance(stock, Round):
        solid = cq.Workplane("XY").circle(stock.diameter / 2).extrude(stock.length)
        if not stock.bore:
            return solid
        start = stock.floor or -BEYOND
        plane = cq.Workplane("XY", origin=(0, 0, start))
        return solid.cut(plane.circle(stock.bore / 2).extrude(stock.length + BEYOND - start))
    wide, side = stock.breadth, -stock.sagitta
    plan = cq.Workplane("XZ").moveTo(0, -stock.thickness).lineTo(wide, -stock.thickness)
    plan = plan.lineTo(wide, side).threePointArc((wide / 2, 0), (0, side)).close()
    return plan.extrude(-stock.height)


def write_step(solid: Any, path: Path) -> None:
    """Write a solid as a STEP file, mm.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    with beside(Path(path)) as part:
        cadquery().exporters.export(solid, str(part), exportType="STEP")


def triangles(solid: Any) -> tuple[Floats, Ints]:
    """Cover a solid with triangles, within 10 µm of its curved sides.

    Returns
    -------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
        Counter-clockwise seen from outside; faces of the solid share their corners.
    """
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    shape = solid.val()
    # Meshed here, since cadquery takes the distance as a share of each edge's length.
    BRepMesh_IncrementalMesh(shape.wrapped, CHORD, False, TURN, False)
    points, faces = shape.tessellate(CHORD, TURN)
    placed = np.array([point.toTuple() for point in points]).round(DIGITS) + 0.0
    vertices, same = np.unique(placed, axis=0, return_inverse=True)
    corners = same.ravel()[np.array(faces, np.int64)]
    return vertices, corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
