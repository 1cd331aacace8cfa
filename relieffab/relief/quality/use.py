"""Whether the depth that the panel gives is made use of."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.quality.pair import Pair

BINS = 64


@dataclass(frozen=True)
class Use:
    """Use of the depth, over the nodes inside the figure (all four pixels in M).

    Parameters
    ----------
    span : float
        (P99 - P1) of the heights over the depth.
    entropy : float
        Of the heights' histogram in 64 even bins from -depth to 0, over ln 64: 0
        for one height, 1 if all are as frequent.
    at_depth, at_face : float
        Share of the nodes at the lower and at the upper bound.
    """

    span: float
    entropy: float
    at_depth: float
    at_face: float


def inner_nodes(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Nodes all of whose four pixels are in the figure, (rows + 1, cols + 1)."""
    four = mask[:-1, :-1] & mask[:-1, 1:] & mask[1:, :-1] & mask[1:, 1:]
    return np.pad(four, 1)


def use(pair: Pair) -> Use:
    """See how the heights fill the depth."""
    depth = pair.relief.depth
    heights = pair.relief.heights[inner_nodes(pair.layers.mask)] / depth
    if not heights.size:
        return Use(*[float("nan")] * 4)
    low, high = np.percentile(heights, (1, 99))
    share = np.histogram(heights, BINS, (-1.0, 0.0))[0] / heights.size
    share = share[share > 0]
    return Use(
        span=float(high - low),
        entropy=float(abs((share * np.log(share)).sum()) / np.log(BINS)),
        at_depth=float((heights <= -1.0 + 1e-9).mean()),
        at_face=float((heights >= -1e-9).mean()),
    )
