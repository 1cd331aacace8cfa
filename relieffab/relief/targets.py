"""Layers to the terms of the energy: what is asked of every pixel and node."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.model import Layers
from relieffab.layers.occlusion import beside, occlusions, slopes
from relieffab.relief.compress import INK, compress, form, without_specks
from relieffab.relief.energy.terms import Bounds, Terms, Weights
from relieffab.relief.groove import inked, swept
from relieffab.relief.model import inner_nodes, nodes_of, pixel_slopes, to_nodes
from relieffab.relief.names import ALL, LINES, SUNKEN, SURFACE, known, part
from relieffab.relief.reach import Leaves, Profile
from relieffab.relief.window import figure_size

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

DEEPEST_LINE = 0.4  # mm, unless asked for: deeper ones take more from the forms than they show
BRIDGE = 0.4  # least stencil across occlusions: parts that hang by nothing slip freely
TWIST = 0.1  # share of the other terms' weight that a pixel's twist gets


@dataclass(frozen=True)
class Carving:
    """How a relief is carved: lengths in mm, weights plain numbers.

    Parameters
    ----------
    depth : float
        Of the relief at its deepest, mm.
    line_depth : float or None
        Of a line at full strength, below the surface around it, mm; a sixteenth
        of the depth, at most 0.4 mm, if None.
    form_length : float or None
        Forms wider than this follow the depth order, finer ones the shading, mm;
        2 % of the figure's width or height, whichever is larger, if None.
    wall_angle : float
        Of the wall at the figure's edge against the panel's face, degrees; 90 for a
        free one.
    fillet : float
        Radius of a ball that reaches floor and wall, each for itself, and of the arc
        at the foot between them: what is narrower is filled, so that a cutter with
        that tip carves nearly all of what is shown, mm.
    depth_weight, light_weight, line_weight, form_weight : float
    method : str
        'sunken', which all of the above serves, or a method of `relief.classic`,
        which takes the depth alone; wall and fillet are the same for all.
    carve : str
        'all', 'surface' for one without lines, or 'lines' for a drawing cut into the
        level face, as deep as the relief unless `line_depth` says otherwise (Wang
        2011, Fig. 6).
    line_tip : callable, optional
        Distance from a cutter's axis to its height above its lowest point, mm: lines
        are grooves of that shape, deeper for principal ones, and not rounded strokes.
    reachable : callable, optional
        What the finest cutter leaves of heights at nodes, given those and the pitch, mm,
        as `toolpath.reach.leaves` says it: the relief is solved for what the ball
        reaches (forms that it cannot are given up, and their surroundings find their
        best heights with what is left), and raised where the cutter could come no
        nearer than `reach.NEAR`.
    """

    depth: float = 3.0
    line_depth: float | None = None
    form_length: float | None = None
    wall_angle: float = 80.0
    fillet: float = 0.25
    depth_weight: float = 4.0
    light_weight: float = 1.0
    line_weight: float = 10.0
    form_weight: float = 1.0
    method: str = SUNKEN
    carve: str = ALL
    line_tip: Profile | None = None
    reachable: Leaves | None = None

    def __post_init__(self) -> None:
        known(self.method)
        part(self.carve)
        if not 0 < self.depth < np.inf:
            raise InputError(
                "the relief needs a depth", expected="more than 0 mm", found=f"{self.depth:g} mm"
            )
        if not 0 < self.wall_angle <= 90:
            raise InputError(
                "the wall cannot stand at that angle",
                expected="more than 0, at most 90 degrees",
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


def line_depth(carving: Carving) -> float:
    """How deep a line at full strength is cut, mm."""
    if carving.carve == SURFACE:
        return 0.0
    if carving.line_depth is not None:
        return carving.line_depth
    if carving.carve == LINES:
        return carving.depth
    return min(carving.depth / 16, DEEPEST_LINE)


def _grooves(layers: Layers, carving: Carving) -> tuple[Floats, Floats]:
    """Profile of the lines on nodes, mm, and how much pixels belong to them, 0 to 1."""
    deep = line_depth(carving)
    if carving.line_tip is None:
        cut, lined = inked(layers, deep), layers.lines > INK
    else:
        cut = swept(layers, deep, carving.line_tip)
        lined = np.minimum(cut[:-1, :-1], cut[1:, 1:]) < 0
    stencil = ndimage.gaussian_filter(lined.astype(float), 0.1 / layers.pitch)
    return cut, stencil * (deep > 0)


def terms_of(layers: Layers, carving: Carving, fitted: Fit, bounds: Bounds) -> Terms:
    """Put the energy's terms together.

    Occlusions part the figure: the depth term leaves them out, and the line term
    asks for the form's own step where a line is drawn on them.  The light term
    asks for the radiance of the slopes asked for.  The model's own would be out of
    a low relief's reach, and pull every surface to its steepest.

    Parameters
    ----------
    layers : Layers
        Its figure at least three pixels from the edge of its grid.
    carving : Carving
    fitted : Fit
    bounds : tuple of ndarray of float32 and float
        Lowest and highest height allowed, mm.

    Returns
    -------
    Terms
    """
    mask, pitch = layers.mask, layers.pitch
    form_length = carving.form_length or 0.02 * max(figure_size(layers))
    slope = slopes(layers)
    across, down = occlusions(layers, slope)
    torn = without_specks(layers, beside(across, down))
    level = form(layers, fitted.span)
    base = to_nodes(level, mask.astype(float))
    cut, stencil = _grooves(layers, carving)
    asked = np.where(torn, pixel_slopes(base, pitch), fitted.gain * compress(slope))
    asked += pixel_slopes(cut, pitch) * mask
    count = int(mask.sum())
    figure = nodes_of(mask)
    stiffness = carving.depth_weight + carving.light_weight * (form_length / pitch) ** 2
    weights = Weights(
        depth=carving.depth_weight / count,
        line=carving.line_weight / count,
        twist=TWIST * stiffness / count,
        light=carving.light_weight * form_length**2 / count,
        form=carving.form_weight / form_length**2 / count,
    )
    return Terms(
        pitch=pitch,
        lights=layers.lights,
        weights=weights,
        mask=mask & ~torn,
        stencil=np.where(torn, np.maximum(stencil, BRIDGE), stencil * mask).astype(np.float32),
        slope=asked.astype(np.float32),
        whole=inner_nodes(mask),
        radiance=None,
        figure=figure,
        form=((base + cut) * figure).astype(np.float32),
        bounds=bounds,
    )
