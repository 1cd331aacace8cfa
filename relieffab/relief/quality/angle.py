"""Whether the relief leans the way the model does."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from relieffab.relief.quality.pair import Pair

Floats = NDArray[np.float64]

STEEP = 3.0  # slopes beyond this weigh no more
SCALES = np.logspace(-3, 3, 31)  # tried before the best is narrowed down
SAMPLE = 20_000  # pixels that do to find the scale


@dataclass(frozen=True)
class Angle:
    """Angles between the relief and its model, over pixels of Ms no occlusion touches.

    Parameters
    ----------
    gradient : float
        Between the directions of steepest ascent, degrees, 0 to 180; the mean with
        weights min(slope of the model, 3).  Where the relief is flat it counts 90.
        Linear compression scores best by construction: never read it alone.
    normal : float
        Between the normals, degrees, after the heights are multiplied by the one
        number that makes it least.
    scale : float
        That number.
    """

    gradient: float
    normal: float
    scale: float


def gradient_angle(model: Floats, relief: Floats) -> float:
    """Weighted mean angle between slopes, degrees.

    Parameters
    ----------
    model, relief : (2, n) ndarray
    """
    steep = np.hypot(model[0], model[1])
    weight = np.minimum(steep, STEEP)
    if not weight.sum() > 0:
        return float("nan")
    dot = model[0] * relief[0] + model[1] * relief[1]
    cross = model[0] * relief[1] - model[1] * relief[0]
    angle = np.degrees(np.arctan2(np.abs(cross), dot))
    flat = np.hypot(relief[0], relief[1]) < 1e-12
    return float(np.average(np.where(flat, 90.0, angle), weights=weight))


def normal_angle(model: Floats, relief: Floats, scale: float) -> float:
    """Mean angle between the normals of slopes, the relief's scaled, degrees."""
    p, q = relief * scale
    dot = 1.0 + model[0] * p + model[1] * q
    cross = (model[0] - p) ** 2 + (model[1] - q) ** 2 + (model[0] * q - model[1] * p) ** 2
    return float(np.degrees(np.arctan2(np.sqrt(cross), dot)).mean())


def angle(pair: Pair) -> Angle:
    """Compare the relief's slopes and normals with the model's."""
    model, relief = pair.model_slopes[:, pair.sound], pair.slopes[:, pair.sound]
    if not model.size:
        return Angle(*[float("nan")] * 3)
    few = slice(None, None, max(1, model.shape[1] // SAMPLE))

    def at(power: float) -> float:
        return normal_angle(model[:, few], relief[:, few], 10.0**power)

    powers = np.log10(SCALES)
    start = powers[int(np.argmin([at(power) for power in powers]))]
    step = powers[1] - powers[0]
    best = minimize_scalar(at, bounds=(start - step, start + step), method="bounded")
    scale = float(10.0**best.x)
    return Angle(gradient_angle(model, relief), normal_angle(model, relief, scale), scale)
