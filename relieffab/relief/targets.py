"""Layers to the terms of the energy: what is asked of every pixel and node."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.model import Layers
from relieffab.layers.shading import lambert
from relieffab.relief.compress import beside, compress, form, occlusions, slopes, steps
from relieffab.relief.energy import Bounds, Terms
from relieffab.relief.model import nodes_of, pixel_slopes
from relieffab.relief.names import SUNKEN, known
from relieffab.relief.window import figure_size

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

STEP = 1 / 16  # of the depth: what stays of a jump between two parts of the figure
TWIST = 0.05  # share of the other terms' weight that a pixel's twist gets


@dataclass(frozen=True)
class Carving:
    """How a relief is carved: lengths in mm, weights plain numbers.

    Parameters
    ----------
    depth : float
        Of the relief at its deepest, mm.
    line_depth : float or None
        Of a line at full strength, below the surface around it, mm; a sixteenth
        of the depth if None.
    form_length : float or None
        Forms wider than this follow the depth order, finer ones the shading, mm;
        2 % of the figure's width or height, whichever is larger, if None.
    wall_angle : float
        Of the wall at the figure's edge against the panel's face, degrees.
    fillet : float
        Radius of a ball that reaches everywhere: what is narrower is filled, so
        that a cutter with that tip carves what is shown, mm.
    depth_weight, light_weight, line_weight, form_weight : float
    method : str
        'sunken', which all of the above serves, or a method of `relief.classic`,
        which takes the depth alone; wall and fillet are the same for all.
    """

    depth: float = 3.0
    line_depth: float | None = None
    form_length: float | None = None
    wall_angle: float = 80.0
    fillet: float = 0.25
    depth_weight: float = 4.0
    light_weight: float = 1.0
    line_weight: float = 4.0
    form_weight: float = 1.0
    method: str = SUNKEN

    def __post_init__(self) -> None:
        known(self.method)
        if not 0 < self.depth < np.inf:
            raise InputError(
                "the relief needs a depth", expected="more than 0 mm", found=f"{self.depth:g} mm"
            )
        if not 0 < self.wall_angle < 90:
            raise InputError(
                "the wall cannot stand at that angle",
                expected="more than 0, less than 90 degrees",
                found=f"{self.wall_angle:g}",
            )
        for name in ("line_depth", "form_length", "fillet"):
            value = getattr(self, name)
            if value is not None and not 0 <= value < np.inf:
                raise InputError(f"{name} cannot be {value:g} mm", expected="0 mm or more")
        if self.form_length == 0:
            raise InputError("form_length cannot be 0 mm", expected="more than 0 mm")
        weights = {
            name: getattr(self, name)
            for name in ("depth_weight", "light_weight", "line_weight", "form_weight")
        }
        for name, value in weights.items():
            if not 0 <= value < np.inf:
                raise InputError(f"{name} cannot be {value:g}", expected="0 or more")
        if self.form_weight == 0:
            raise InputError(
                "the form weight cannot be 0: without it no height is better than another",
                expected="more than 0",
            )


@dataclass(frozen=True)
class Fit:
    """How the figure is made to fit its depth.

    Parameters
    ----------
    span : tuple of float
        Heights of the form's farthest and nearest point, mm.
    gain : float
        What the slopes asked for are multiplied by, at most 1.
    """

    span: tuple[float, float]
    gain: float


def to_nodes(pixels: Floats, weight: Floats) -> Floats:
    """Weighted means of the up to four pixels around each node.

    Parameters
    ----------
    pixels, weight : (rows, cols) ndarray

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        0 where no pixel has weight.
    """
    total, mass = np.zeros((2, pixels.shape[0] + 1, pixels.shape[1] + 1))
    for i in (slice(None, -1), slice(1, None)):
        for j in (slice(None, -1), slice(1, None)):
            total[i, j] += pixels * weight
            mass[i, j] += weight
    return np.divide(total, mass, out=np.zeros_like(total), where=mass > 0)


def groove(layers: Layers, line_depth: float) -> Floats:
    """Profile of the lines on nodes, 0 beside them, negative in them, mm.

    Ink is rounded over a third of a millimetre, so that strokes have flanks a
    cutter can follow; full strength reaches the line depth.
    """
    ink = ndimage.gaussian_filter(layers.lines, 0.12 / layers.pitch)
    return -line_depth * to_nodes(np.minimum(1.25 * ink, 1.0), np.ones_like(ink))


def _one_surface(mask: Bools, across: Bools, down: Bools) -> Bools:
    """Nodes whose four pixels are in the figure with no occlusion between them."""
    whole = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), bool)
    four = mask[:-1, :-1] & mask[:-1, 1:] & mask[1:, :-1] & mask[1:, 1:]
    torn = across[:-1] | across[1:] | down[:, :-1] | down[:, 1:]
    whole[1:-1, 1:-1] = four & ~torn
    return whole


def terms_of(layers: Layers, carving: Carving, fitted: Fit, bounds: Bounds) -> Terms:
    """Put the energy's terms together.

    Parameters
    ----------
    layers : Layers
        Its figure at least three pixels from the edge of its grid.
    carving : Carving
    fitted : Fit
    bounds : tuple of ndarray or float
        Lowest and highest height allowed, mm.

    Returns
    -------
    Terms
    """
    mask, pitch = layers.mask, layers.pitch
    form_length = carving.form_length or 0.02 * max(figure_size(layers))
    line_depth = carving.depth / 16 if carving.line_depth is None else carving.line_depth
    slope = slopes(layers)
    across, down = occlusions(layers, slope)
    torn = beside(across, down)
    stepped = steps(layers, across, down, STEP * carving.depth)
    cut = groove(layers, line_depth)
    cut_slope = pixel_slopes(cut, pitch) * mask
    count = int(mask.sum())
    stencil = ndimage.gaussian_filter((layers.lines > 0.02).astype(float), 0.1 / pitch)
    figure = nodes_of(mask)
    base = to_nodes(form(layers, fitted.span), mask.astype(float)) + cut
    depth_weight = carving.depth_weight * mask / count
    line_weight = carving.line_weight * stencil * mask / count
    light_weight = carving.light_weight * form_length**2 * _one_surface(mask, across, down) / count
    corners = light_weight[:-1, :-1] + light_weight[:-1, 1:]
    corners += light_weight[1:, :-1] + light_weight[1:, 1:]
    return Terms(
        pitch=pitch,
        lights=layers.lights,
        depth_weight=depth_weight,
        line_weight=line_weight,
        slope=np.where(torn, stepped, fitted.gain * compress(slope, mask)) + cut_slope,
        light_weight=light_weight,
        radiance=layers.shading + _tilted(layers, cut_slope),
        twist_weight=TWIST * (depth_weight + line_weight + corners / (4 * pitch**2)),
        form_weight=carving.form_weight * figure / form_length**2 / count,
        form=base * figure,
        bounds=bounds,
    )


def _tilted(layers: Layers, cut_slope: Floats) -> Floats:
    """Change of the shading where lines tilt the surface, (k, rows, cols)."""
    tilted = layers.normals.copy()
    tilted[..., 0] -= cut_slope[0] * layers.normals[..., 2]
    tilted[..., 1] -= cut_slope[1] * layers.normals[..., 2]
    tilted /= np.linalg.norm(tilted, axis=2, keepdims=True)
    return lambert(tilted, layers.lights) - lambert(layers.normals, layers.lights)
