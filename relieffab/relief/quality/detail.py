"""Whether detail is kept, band by band."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.relief.quality.pair import Pair, correlation

Floats = NDArray[np.float64]

SCALES = (1, 2, 4, 8)
REACH = 3.0  # sigmas after which a Gaussian ends
CLEAR = 2.0  # a band's pixels are this many of its scales away from where walls may stand
FEWEST = 64  # pixels below which nothing is said


@dataclass(frozen=True)
class Detail:
    """Correlation of the relief's heights with the model's depth, band by band.

    A band at s pixels is G(s) - G(2s), with Gaussian means over the figure's own
    pixels.  It is compared on pixels 2s or more away from the strip along the
    figure's edge and occlusions (`Pair.strip`), whose walls would drown it.  0 for a
    flat relief; NaN where fewer than 64 pixels are that far away.

    Parameters
    ----------
    s1, s2, s4, s8 : float
        -1 to 1.
    """

    s1: float
    s2: float
    s4: float
    s8: float


def detail(pair: Pair) -> Detail:
    """Compare the relief's detail with the model's."""
    box = ndimage.find_objects(pair.layers.mask.astype(np.int8))[0]
    mask = pair.layers.mask[box].astype(float)
    fields = mask, pair.layers.depth[box] * mask, pair.heights[box] * mask
    far = pair.from_edge[box]
    finer: tuple[Floats, Floats] | None = None
    out = []
    for s in (*SCALES, 2 * SCALES[-1]):
        mass, model, relief = (
            ndimage.gaussian_filter(field, s, truncate=REACH, mode="constant") for field in fields
        )
        mass = np.maximum(mass, 1e-9)
        coarser = model / mass, relief / mass
        if finer is not None:
            where = far >= pair.strip + CLEAR * s / 2
            a, b = ((one - other)[where] for one, other in zip(finer, coarser, strict=True))
            out.append(correlation(a, b) if a.size >= FEWEST else float("nan"))
        finer = coarser
    return Detail(*out)
