"""The sunken relief as its paper has it (Wang, Chang, Kerber, Zhang 2011), for comparison.

Compressed gradients (Eqs. 9-12), radiance of the model's own under the same lights
with the normals' length lagged by one iteration (Eqs. 13-16), a line image dark on
bright under its stencil (Eqs. 17-19), scalar weights (Eq. 20), bounds (Eq. 21).
Where the printed equations cannot be coded (see the signs and squares of Eqs. 8, 10
and 19), the nearest thing that can; a faint pull towards linear compression stands
for what Eq. 20 leaves open, every height's constant and long waves.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.relief.bounds import deepest, hold, move, within
from relieffab.relief.classic.figure import extent, model_slopes
from relieffab.relief.classic.gradient import KNEE, attenuate
from relieffab.relief.classic.linear import linear
from relieffab.relief.descend import newton
from relieffab.relief.energy.linearise import linearise
from relieffab.relief.energy.terms import Terms, Weights
from relieffab.relief.model import inner_nodes, nodes_of
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]

DEPTH_WEIGHT, LIGHT_WEIGHT = 0.1, 1.0  # of light and lines alike, with pixels as the unit of length
EXPONENT = 0.8  # of the compression
FAINT = 1e-2  # of the pull towards linear compression, over the figure's extent squared
ROUNDS = 12  # of lagging, at most
STILL = 1e-3  # of the depth: heights that move less are done
CAREFUL = 1e-3  # tolerance of each round


def _terms(figure: Layers, depth: float) -> Terms:
    slope, whole = model_slopes(figure)
    one = nodes_of(figure.mask)
    count, pitch = int(figure.mask.sum()), figure.pitch
    drawn = figure.shading * (1.0 - figure.lines)
    return Terms(
        pitch=pitch,
        lights=figure.lights,
        weights=Weights(
            depth=DEPTH_WEIGHT / count,
            line=0.0,
            twist=DEPTH_WEIGHT / 16 / count,
            light=LIGHT_WEIGHT * pitch**2 / count,
            form=FAINT / extent(figure) ** 2 / count,
        ),
        mask=figure.mask,
        stencil=np.zeros(figure.grid.shape, np.float32),
        slope=attenuate(slope, whole, knee=KNEE, exponent=EXPONENT).astype(np.float32),
        whole=inner_nodes(whole),
        radiance=drawn.astype(np.float32),
        figure=one,
        form=linear(figure, depth).astype(np.float32),
        bounds=(np.full(one.shape, deepest(depth)), 0.0),
        lagged=True,
    )


def wang(layers: Layers, depth: float) -> Floats:
    """Solve the paper's energy by its own iteration.

    Each round takes the normals' length from the round before, which leaves a
    linear problem with bounds.

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
    figure, place = cropped(layers)
    terms = _terms(figure, depth)
    heights = within(terms.form, terms.bounds, terms.figure)
    for _ in range(ROUNDS):
        here = linearise(terms, heights)
        free, pull, norm = hold(here.gradient, heights, terms.bounds, terms.figure)
        if norm == 0:
            break
        step, _ = newton(here, free, pull, CAREFUL)
        before, heights = heights, move(heights, step, 1.0, terms.bounds)
        if np.abs(heights - before).max() < STILL * depth:
            break
    return place.put(heights, layers.grid.node_shape)
