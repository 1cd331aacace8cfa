"""How the form and the detail share the depth."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.relief.descend import descend
from relieffab.relief.edge import inward_distance
from relieffab.relief.names import LINES
from relieffab.relief.targets import Carving, Fit, line_depth, terms_of
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]

HALVINGS = 12  # of the interval in which the form's span is sought
OUTSIDE = (2.0, 98.0)  # percentiles of the heights that have to lie within the bounds
TOP = 0.02  # of the depth, kept above the upper of them
SHARE = 0.36  # of the depth: what the slopes' own heights may take
RIM = 1.5  # mm from the edge that do not count


def fit(layers: Layers, carving: Carving) -> Fit:
    """Choose the form's span and the slopes' gain so that the relief fits its depth.

    Without bounds, lines and light the heights are linear in both: the form's own,
    smoothed, times the span, and those of the slopes alone times the gain.  The
    gain is what lets the latter take their share of the depth, at most 1; the span
    takes what is left, at most the whole.  The rim does not count: the wall covers
    it.

    Parameters
    ----------
    layers : Layers
        A coarse grid does.
    carving : Carving

    Returns
    -------
    Fit
    """
    if carving.carve == LINES:
        return Fit((0.0, 0.0), 0.0)
    figure, _ = cropped(layers)
    depth = carving.depth
    smooth = replace(carving, light_weight=0.0, line_weight=0.0, line_depth=0.0)
    far = inward_distance(figure.mask)
    inner = far > min(RIM / figure.pitch, 0.5 * max(float(far.max()), 0.0))

    free = np.full(figure.grid.node_shape, -np.inf, np.float32), np.inf

    def heights(fitted: Fit) -> Floats:
        terms = terms_of(figure, smooth, fitted, free)
        solved, _ = descend(terms, terms.form.astype(float), tolerance=1e-2, most=2)
        return solved[inner if inner.any() else terms.figure]

    order, detail = heights(Fit((0.0, 1.0), 0.0)), heights(Fit((0.0, 0.0), 1.0))
    bottom, top = np.percentile(detail, OUTSIDE)
    gain = min(1.0, SHARE * depth / max(float(top - bottom), 1e-9))
    room = max((1.0 - TOP) * depth - line_depth(carving), 0.5 * depth)
    low, high = 0.0, depth
    for _ in range(HALVINGS):
        span = 0.5 * (low + high)
        bottom, top = np.percentile(span * order + gain * detail, OUTSIDE)
        low, high = (span, high) if top - bottom < room else (low, span)
    farthest = -TOP * depth - float(top)
    return Fit((farthest, farthest + span), gain)
