"""Whether the relief, lit, looks as the model does."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.shading import lambert, light_at
from relieffab.relief.quality.pair import Pair, correlation, normals_of

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SIGMA = 1.5  # of the window of the similarity, pixels
REACH = 3.5  # sigmas after which the window ends: 11 x 11 pixels
K1, K2 = 0.01, 0.03


@dataclass(frozen=True)
class Relit:
    """Likeness of the lit relief to the lit model, over Ms; NaN where that is empty.

    Frontal is the light from the viewer, which tells steepness alone.  Oblique is
    the mean over two lights 45 degrees above the panel, 45 degrees to the left and
    to the right of its far side, which tell which way surfaces lean.

    Parameters
    ----------
    frontal_ncc, oblique_ncc : float
        Correlation of the radiances, -1 to 1; 0 for a flat relief.
    frontal_ssim, oblique_ssim : float
        Mean structural similarity after mean and deviation are matched.
    inside_ncc : float
        As oblique_ncc, away from the figure's edge and occlusions, where a carved
        relief has walls that the model has not (`Pair.strip`).
    inside_contrast : float
        Deviation of the relief's radiances over that of the model's on those pixels,
        mean of the oblique lights.  The others do not see how faint a likeness is.
    """

    frontal_ncc: float
    oblique_ncc: float
    frontal_ssim: float
    oblique_ssim: float
    inside_ncc: float
    inside_contrast: float


LIGHTS = np.stack([light_at(0, 90), light_at(-45, 45), light_at(45, 45)])


def similarity(a: Floats, b: Floats, inside: Bools) -> float:
    """Mean structural similarity of two images over a region.

    Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error
    visibility to structural similarity" (2004), Eq. 13, for radiances from 0 to 1.
    The window's weights are those of the region's pixels alone.  The second image
    is first given the mean and the deviation of the first.

    Parameters
    ----------
    a, b : (rows, cols) ndarray
    inside : (rows, cols) ndarray of bool

    Returns
    -------
    float
        1 if they are alike; NaN for an empty region.
    """
    if not inside.any():
        return float("nan")
    scale = a[inside].std() / b[inside].std() if np.ptp(b[inside]) > 1e-12 else 0.0
    b = (b - b[inside].mean()) * scale + a[inside].mean()
    mass = ndimage.gaussian_filter(inside.astype(float), SIGMA, truncate=REACH, mode="constant")

    def mean(image: Floats) -> Floats:
        total = ndimage.gaussian_filter(image * inside, SIGMA, truncate=REACH, mode="constant")
        return total[inside] / mass[inside]  # type: ignore[no-any-return]

    m, n = mean(a), mean(b)
    c1, c2 = K1**2, K2**2
    light = (2 * m * n + c1) / (m * m + n * n + c1)
    shared, own = mean(a * b) - m * n, mean(a * a + b * b) - m * m - n * n
    return float((light * (2 * shared + c2) / (own + c2)).mean())


def deviation_ratio(a: Floats, b: Floats) -> float:
    """Deviation of the second over that of the first; NaN if the first do not vary."""
    return float(b.std() / a.std()) if a.size and np.ptp(a) >= 1e-9 else float("nan")


def relit(pair: Pair) -> Relit:
    """Light the relief and the model alike and compare them."""
    box = ndimage.find_objects(pair.inner.astype(np.int8))
    if not box:
        return Relit(*[float("nan")] * 6)
    inside, clear = pair.inner[box[0]], (pair.from_edge > pair.strip)[box[0]]
    model = lambert(pair.layers.normals[box[0]], LIGHTS)
    lit = lambert(normals_of(pair.slopes[:, *box[0]]), LIGHTS)
    both = list(zip(model, lit, strict=True))
    frontal, *oblique = [correlation(a[inside], b[inside]) for a, b in both]
    frontal_like, *oblique_like = [similarity(a, b, inside) for a, b in both]
    within = [correlation(a[clear], b[clear]) for a, b in both[1:]]
    relative = [deviation_ratio(a[clear], b[clear]) for a, b in both[1:]]
    return Relit(
        frontal_ncc=frontal,
        oblique_ncc=sum(oblique) / 2,
        frontal_ssim=frontal_like,
        oblique_ssim=sum(oblique_like) / 2,
        inside_ncc=sum(within) / 2,
        inside_contrast=sum(relative) / 2,
    )
