"""Reliefs of what has no form: filled areas sunk as deep as the relief, and lines."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.names import DRAWN
from relieffab.layers.model import Layers
from relieffab.relief.edge import wall
from relieffab.relief.foot import carved
from relieffab.relief.groove import inked, swept
from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.names import LINES
from relieffab.relief.reach import ball, closing
from relieffab.relief.targets import Carving, line_depth

Floats = NDArray[np.float64]


def sunk(layers: Layers, carving: Carving) -> Relief:
    """Sink a level figure, and cut its lines into the face.

    Walls lean by the wall angle: an area narrower than two of them has a bottom like
    a V, a wider one a level floor.  Nothing has to be solved for: on a level face
    the lines' own profile is all that is asked.

    Parameters
    ----------
    layers : Layers
        Level.
    carving : Carving
        Of its parts, `lines` leaves areas out and `surface` lines.

    Returns
    -------
    Relief
    """
    pitch = layers.pitch
    heights, mask = np.zeros(layers.grid.node_shape), np.zeros(layers.grid.shape, bool)
    if carving.carve != LINES:
        mask = layers.mask
        edge, figure = wall(mask, pitch, carving.wall_angle, carving.depth), nodes_of(mask)
        floor = np.where(figure, -carving.depth, 0.0)
        heights = carved(floor, figure, edge, pitch, carving)
    cut = closing(_grooves(layers, carving), pitch, ball(carving.fillet))
    below = cut < 0
    mask = mask | below[:-1, :-1] | below[:-1, 1:] | below[1:, :-1] | below[1:, 1:]
    heights = np.where(nodes_of(mask), np.minimum(heights, cut), 0.0)
    return Relief(layers.grid, heights, mask, carving.depth)


def _grooves(layers: Layers, carving: Carving) -> Floats:
    """Profile of the lines on nodes, mm, 0 beside them; an area's own outline is none."""
    deep = min(line_depth(carving), carving.depth)
    if carving.line_tip is None:
        return inked(layers, deep)
    drawn = tuple(stroke for stroke in layers.strokes if stroke.kind == DRAWN)
    return np.maximum(swept(replace(layers, strokes=drawn), deep, carving.line_tip), -deep)
