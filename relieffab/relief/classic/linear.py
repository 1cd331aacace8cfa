"""Linear compression: every height on one scale (Cignoni, Montani, Scopigno 1997)."""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.relief.classic.figure import stretch
from relieffab.relief.model import nodes_of, to_nodes

Floats = NDArray[np.float64]


def linear(layers: Layers, depth: float) -> Floats:
    """Scale the depth of the model so that it fits.

    "Computer-assisted generation of bas- and high-reliefs", for a parallel view: the
    publication's nonlinear part only undoes the depth of a perspective.

    Parameters
    ----------
    layers : Layers
    depth : float
        mm.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        Heights, mm, -depth to 0; 0 outside the figure.
    """
    return stretch(to_nodes(layers.depth, layers.mask.astype(float)), nodes_of(layers.mask), depth)
