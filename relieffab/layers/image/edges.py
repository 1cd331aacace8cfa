"""Lines of a picture: where its surface jumps, folds and turns, or its brightness does."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.image.vector import chains_of
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.contours import fading
from relieffab.layers.lines.contrast import LEAST, contrast
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.kinds import KINDS
from relieffab.layers.lines.strokes import outer_lines, to_stroke, visible_lengths
from relieffab.layers.lines.tidy import STAIRS, Line, Rules, tidy
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.occlusion import occlusions, slopes
from relieffab.layers.raster import Raster

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FOLD = 35.0
"""Turn of the surface over two pixels that is an edge, degrees; twice that is a strong one."""
WIDE, SHARP = 3, 0.7
"""Pixels each way over which a smooth form goes on turning, and the share of that which an edge
turns within one."""
SEEN = 0.35
"""n.v below which a surface turns away: it folds there in any case."""
FADE = 3.0
"""Share of the brightness's largest steps, percent, that are lines of full strength."""
CANNY = (0.1, 0.3)
"""Canny's two thresholds against those steps."""
AROUND = 3.0
"""How much wider the Gaussian is that says how steep brightness is around a step."""
STANDS = 1.5
"""How much steeper than that a step is; a sharp one, standing alone, is `AROUND` times."""


def _sigma(drawing: Drawing, pitch: float) -> float:
    """Deviation of the Gaussian that halves forms of the drawing's detail, pixels."""
    wave = drawing.detail / pitch
    return max(0.7, wave * float(np.sqrt(np.log(2) / 2)) / np.pi)


def _smooth(field: Floats, mask: Bools, sigma: float) -> Floats:
    mass = ndimage.gaussian_filter(mask.astype(float), sigma)
    total = ndimage.gaussian_filter(np.where(mask, field, 0.0), sigma)
    return np.divide(total, mass, out=np.zeros_like(total), where=mass > 1e-6)


def _jumps(layers: Layers) -> Bools:
    """Pixels that stand in front of a neighbour."""
    across, down = occlusions(layers, slopes(layers))
    near = np.zeros(layers.grid.shape, bool)
    rises = np.diff(layers.depth, axis=1) > 0
    near[:, 1:] |= across & rises
    near[:, :-1] |= across & ~rises
    rises = np.diff(layers.depth, axis=0) > 0
    near[1:] |= down & rises
    near[:-1] |= down & ~rises
    return near


def _folds(layers: Layers, jumps: Bools) -> tuple[Bools, Floats]:
    """Pixels on which the surface turns sharply, and how strong an edge that is, 0 to 1.

    It turns at once there, not as the bottom of a groove does.
    """
    n, facing = layers.normals, layers.normals[..., 2] > SEEN
    whole = ndimage.binary_erosion(layers.mask & facing & ~ndimage.binary_dilation(jumps))
    turn = _turn(n, 1)
    edge = whole & (turn > FOLD) & (turn > SHARP * _turn(n, WIDE))
    return np.asarray(edge, bool), np.clip(turn / FOLD - 1.0, 0.1, 1.0)


def _turn(normals: Floats, step: int) -> Floats:
    """Angle between the normals so many pixels before and behind, the larger way, degrees."""
    cosine = np.ones(normals.shape[:2])
    cosine[:, step:-step] = (normals[:, 2 * step :] * normals[:, : -2 * step]).sum(axis=2)
    down = (normals[2 * step :] * normals[: -2 * step]).sum(axis=2)
    cosine[step:-step] = np.minimum(cosine[step:-step], down)
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _ridges(field: Floats, sigma: float) -> tuple[Bools, Floats]:
    """Ridges of a field: greatest across the way it bends most; and that way, X and Y."""
    from skimage.feature import hessian_matrix

    rr, rc, cc = hessian_matrix(field, sigma=sigma, order="rc", use_gaussian_derivatives=False)
    half, apart = 0.5 * (rr + cc), np.hypot(0.5 * (rr - cc), rc)
    least = half - apart
    angle = 0.5 * np.arctan2(2 * rc, rr - cc) + np.pi / 2  # of the least eigenvalue, from rows
    across = np.stack([np.cos(angle), np.sin(angle)])
    at = np.indices(field.shape, float)
    ahead, behind = (
        ndimage.map_coordinates(field, at + sign * across, order=1, mode="nearest")
        for sign in (1.0, -1.0)
    )
    ridge = (least < 0) & (field >= ahead) & (field >= behind)
    return ridge, np.stack([across[1], -across[0]])


def _turning(layers: Layers, drawing: Drawing) -> Chains:
    """Where the surface turns away and back: ridges of the angle off the view.

    Valleys of n.v are where suggestive contours lie (DeCarlo 2003, Sect. 2.2), and
    what a line is worth is told as for a mesh, by half the tilt: a picture is smoothed on its grid.
    """
    grid, sigma = layers.grid, _sigma(drawing, layers.pitch)
    calm = np.stack([_smooth(layers.normals[..., k], layers.mask, sigma) for k in range(3)], -1)
    calm /= np.maximum(np.linalg.norm(calm, axis=2, keepdims=True), 1e-9)
    angle = np.where(layers.mask, np.arccos(np.clip(calm[..., 2], -1.0, 1.0)), -1.0)
    ridge, across = _ridges(np.where(layers.mask, angle, 0.0), 1.0)
    inner = ndimage.binary_erosion(layers.mask, iterations=2)
    chains = chains_of(ridge & inner, np.ones(grid.shape), across, grid)
    if not len(chains.points):
        return chains
    depth = np.where(layers.mask, layers.depth, -np.inf)
    raster = Raster(depth, np.where(layers.mask, 0, -1).astype(np.int32))
    return replace(chains, strength=fading(contrast(chains, angle, raster, grid), LEAST / 2))


def _steps(grey: Floats, layers: Layers, drawing: Drawing) -> tuple[Bools, Floats]:
    """Find steps of brightness (Canny 1986), and how strong they are, 0 to 1.

    Round forms shade evenly: there Canny's crests are those of noise and of eight bits,
    so a step must be steeper than the shading around it.
    """
    from skimage.feature import canny

    sigma = 1.5 * _sigma(drawing, layers.pitch)
    filled = np.where(layers.mask, grey, _smooth(grey, layers.mask, 4 * sigma))
    inner = ndimage.binary_erosion(layers.mask, iterations=int(2 * sigma) + 1)
    steep = ndimage.gaussian_gradient_magnitude(filled, sigma)
    if not inner.any():
        return inner, steep
    full = max(float(np.percentile(steep[inner], 100.0 - FADE)), 1e-9)
    # Canny's own gradient is Sobel's, four times that of a Gaussian's derivative.
    low, high = (4.0 * share * full for share in CANNY)
    lines = canny(filled, sigma=sigma, low_threshold=low, high_threshold=high, mask=inner)
    lines &= steep > STANDS * ndimage.gaussian_gradient_magnitude(filled, AROUND * sigma)
    return lines, np.clip(0.35 + 0.65 * steep / full, 0.0, 1.0)


def draw(layers: Layers, drawing: Drawing, grey: Floats | None = None) -> tuple[Stroke, ...]:
    """Draw what a picture shows in lines.

    Parameters
    ----------
    layers : Layers
        All but the lines.
    drawing : Drawing
        Of its kinds those that a picture can show: outline, contour, crease and
        suggestive.
    grey : (rows, cols) ndarray, optional
        A photograph's brightness: its steps are contours, for its depth has none
        that can be trusted.

    Returns
    -------
    tuple of Stroke
        Kind by kind, principal ones first, of each the longest first.
    """
    drawing = visible_lengths(drawing, layers.pitch)
    grid, flat = layers.grid, np.zeros((2, *layers.grid.shape))
    drawn: list[Line] = outer_lines(layers.mask, grid, drawing.min_length)
    ones = np.ones(grid.shape)
    jumps = _jumps(layers) if grey is None else np.zeros(grid.shape, bool)
    for kind in KINDS:
        if kind.name not in drawing.kinds or kind.name == "outline":
            continue
        if kind.name == "contour":
            lines, strength = (jumps, ones) if grey is None else _steps(grey, layers, drawing)
            chains = chains_of(lines, strength, flat, grid)
        elif kind.name == "crease" and grey is None:
            chains = chains_of(*_folds(layers, jumps), flat, grid)
        elif kind.name == "suggestive":
            chains = _turning(layers, drawing)
        else:
            continue
        rules = Rules.of(kind, drawing, grid.pitch)
        rules = replace(rules, softness=max(rules.softness, STAIRS * grid.pitch))
        drawn += tidy(kind.name, chains, np.ones(len(chains.points), bool), drawn, rules)
    return tuple(to_stroke(line, drawing) for line in drawn if line.kind in drawing.kinds)
