"""Round solids: a relief cut into a column, a ring, a cup, or a gently curved board."""

from collections.abc import Iterator
from dataclasses import replace
from math import ceil, pi

import manifold3d
import numpy as np

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.panel.bent import bent_error, refine
from relieffab.panel.carve import accept, surface_below
from relieffab.panel.model import Panel, Sinking
from relieffab.panel.sinking import sink
from relieffab.panel.solid import checked, manifold_of, panel_of
from relieffab.panel.space import solid_above
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief
from relieffab.round import Curved, Round, check_depth, check_on, chord
from relieffab.stock import Stock

# Shares of the tolerance: for the triangles on the flat panel, and for chords.
FLAT, CHORD = 0.6, 0.15
BEYOND = 1.0  # mm that a bore is cut further than the ends
SEAM = 1e-6  # mm by which the left and right edge of a relief all round may differ


def blank_of(stock: Round | Curved, tolerance: float) -> manifold3d.Manifold:
    """Make the uncut stock, its axis along Y, the middle of its panel facing up.

    Its facets' corners lie on the face.

    Parameters
    ----------
    stock : Round or Curved
    tolerance : float
        Of the solid; facets keep to their share of it, mm.
    """
    step = chord(stock.bend.radius, CHORD * tolerance)
    if isinstance(stock, Round):
        count = max(ceil(2 * pi / step), 12)
        radius, bore = stock.diameter / 2, stock.bore / 2
        solid = manifold3d.Manifold.cylinder(stock.length, radius, radius, count)
        if bore:
            start = stock.floor or -BEYOND
            hole = manifold3d.Manifold.cylinder(stock.length + BEYOND - start, bore, bore, count)
            solid = solid - hole.translate((0.0, 0.0, start))
        return checked(solid.rotate((-90.0, 0.0, 0.0)), "the stock")
    half = stock.width / stock.radius / 2
    angles = np.linspace(half, -half, max(ceil(2 * half / step), 1) + 1)
    face = stock.radius * np.stack([np.sin(angles), np.cos(angles)], axis=1)
    back = stock.radius - stock.thickness
    profile = np.concatenate([face, [[face[-1, 0], back], [face[0, 0], back]]])
    solid = manifold3d.CrossSection([profile]).extrude(stock.height)
    upright = solid.rotate((90.0, 0.0, 0.0)).translate((0.0, stock.height, 0.0))
    return checked(upright, "the stock")


def _sinkings(relief: Relief, stock: Round | Curved) -> Iterator[Sinking]:
    """Take what is cut of a relief; of one that is cut at its seam, two halves that overlap."""
    check_on(stock, relief.grid)
    check_depth(stock, relief.depth)
    grid, h = relief.grid, relief.heights
    # Beside the panel the face goes on: the cut ends there in walls, but runs out at the ends.
    (x, y), pitch = grid.origin, grid.pitch
    height = stock.length if isinstance(stock, Round) else stock.height
    wide = Stock(stock.width + 4 * pitch, height, stock.wall)
    shifted = replace(relief, grid=Grid(grid.rows, grid.cols, pitch, (x + 2 * pitch, y)))
    whole = sink(shifted, wide)
    left, far = whole.grid.origin
    sunk = whole.heights
    reaches = stock.all_round and grid.cols * pitch > stock.bend.around - SEAM
    if not (reaches and (h[:, [0, -1]] < 0).any()):
        yield Sinking(Grid(*whole.grid.shape, pitch, (left - 2 * pitch, far)), sunk)
        return
    if np.abs(h[:, 0] - h[:, -1]).max() > SEAM:
        row = int(np.abs(h[:, 0] - h[:, -1]).argmax())
        raise InputError(
            "the relief does not join where its edges meet",
            expected="equal heights on its left and right edge",
            found=f"{h[row, 0]:.4g} and {h[row, -1]:.4g} mm at Y {grid.to_xy(row, 0)[1]:.2f}",
        )
    half = grid.cols // 2
    for start, stop in ((0, half + 1), (half, grid.cols + 1)):
        columns = np.arange(start, stop + 1) % grid.cols
        part = Grid(whole.grid.rows, stop - start, pitch, (x + start * pitch, far))
        yield Sinking(part, sunk[:, columns].copy())


def make_round(
    relief: Relief,
    stock: Round | Curved,
    *,
    tolerance: float = 0.02,
    progress: Progress = silent,
) -> Panel:
    """Carve a relief into a round stock or a curved board.

    Parameters
    ----------
    relief : Relief
        On the flat panel that is wrapped round the stock.
    stock : Round or Curved
    tolerance : float, optional
        Largest distance between solid and relief at any point, mm, as `bent_error` has it.
    progress : Progress, optional

    Returns
    -------
    Panel
        A round one stands on Z0, its axis through X0 Y0, the panel's middle facing -Y;
        a board lies on its back like a flat panel, its middle at Z0.  Watertight, its
        error measured.

    Raises
    ------
    InputError
        If the tolerance is not a length, the stock cannot hold the relief, or a relief
        all round does not join.
    RelieffabError
        If the result breaks the tolerance or is no solid; neither should be.
    """
    if not 0 < tolerance < stock.wall:
        raise InputError(
            "the solid's tolerance cannot be met",
            expected=f"more than 0 mm, less than the wall's {stock.wall:g} mm",
            found=f"{tolerance:g} mm",
        )
    bend, solid = stock.bend, blank_of(stock, tolerance)
    for sinking in _sinkings(relief, stock):
        surface, _ = surface_below(sinking, FLAT * tolerance, progress)
        if len(surface.faces):
            least = bend.radius - relief.depth
            vertices, faces = refine(*solid_above(surface), least, CHORD * tolerance)
            space = manifold_of(bend.bent(vertices), faces, "the space above the relief")
            progress("carve", 0, 1)
            solid = checked(solid - space, "the carved stock")
    carved = panel_of(solid, 0.0)
    error = bent_error(carved.vertices, carved.faces, relief, bend)
    progress("carve", 1, 1)
    return accept(_placed(replace(carved, max_error_mm=error), stock), tolerance)


def _placed(carved: Panel, stock: Round | Curved) -> Panel:
    x, y, z = carved.vertices.T
    if isinstance(stock, Round):
        return replace(carved, vertices=np.stack([x, -z, y], axis=1))
    return replace(carved, vertices=np.stack([x - x.min(), y, z - stock.radius], axis=1))


def facing(solid: Panel, stock: Round | Curved) -> Panel:
    """Lay a solid down so that the middle of its panel faces up, as pictures take it."""
    if isinstance(stock, Curved):
        return solid
    x, y, z = solid.vertices.T
    return replace(solid, vertices=np.stack([x, z, -y], axis=1))
