"""What depth maps and normal maps show: depth and normals on the panel's grid."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.image import normalmap
from relieffab.layers.image.bands import repair
from relieffab.layers.image.fit import Fit
from relieffab.layers.image.guide import guided
from relieffab.layers.image.integrate import integrate
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.rims import rim_length
from relieffab.layers.image.scale import to_length, white_is_far
from relieffab.layers.image.sight import Facts
from relieffab.layers.image.steps import normals_of, slopes_of

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Laid:
    """A picture whose figure was found and has its place on the panel.

    Parameters
    ----------
    picture : Picture
    mask : (rows, cols) ndarray of bool
        The figure, in the picture's own pixels.
    source : str
        What told it.
    fit : Fit
        Where these lie on the panel.
    there : ndarray of bool
        The figure on the panel's grid.
    """

    picture: Picture
    mask: Bools
    source: str
    fit: Fit
    there: Bools


def form_of_depth(
    laid: Laid, facts: Facts, *, far: bool = False, deep: float | None = None
) -> tuple[Floats, Floats]:
    """Take the form that a depth map shows.

    Parameters
    ----------
    laid : Laid
    facts : dict
        Gets what was found of levels, their order and the depth.
    far : bool, optional
        Whether white is far, whatever the map itself tells.
    deep : float or None
        From the farthest to the nearest point, mm.

    Returns
    -------
    depth : ndarray
        On the grid, mm, larger is nearer.
    normals : ndarray
        Unit vectors, on the grid.

    Raises
    ------
    InputError
        If the map is level.
    """
    picture, mask, fit, there = laid.picture, laid.mask, laid.fit, laid.there
    white_far, by = (True, "setting") if far else white_is_far(picture, mask, laid.source)
    grey = np.where(mask, picture.grey, 0.0)
    smooth, bands = repair(-grey if white_far else grey, mask)
    depth = fit.field(to_length(smooth, mask, fit.scale, deep, picture.name), mask)
    facts |= {
        "near": "black" if white_far else "white",
        "near_by": by,
        "depth_mm": float(np.ptp(depth[there])),
        "banding": bands and {
            "levels": bands.levels,
            "step_mm": bands.step / float(np.ptp(smooth[mask])) * float(np.ptp(depth[there])),
            "flat_share": bands.flat,
            "flat_share_after": bands.flat_after,
            "moved_steps": bands.moved,
        },
    }  # fmt: skip
    return depth, normals_of(slopes_of(depth, there, fit.grid.pitch), there)


def form_of_normals(
    laid: Laid, facts: Facts, *, down: bool = False, depth_map: str | None = None
) -> tuple[Floats, Floats]:
    """Take the form that a normal map shows, by integration or with a depth map beside it.

    Parameters
    ----------
    laid : Laid
    facts : dict
        Gets which way green points, the depth, and what was found of the depth map or
        of edges that may hide something.
    down : bool, optional
        Whether green points down, whatever the map itself tells.
    depth_map : str or None
        The depth map's file.

    Returns
    -------
    depth, normals : ndarray
        As of `form_of_depth`.

    Raises
    ------
    InputError
        If these are no normals that face the viewer, or the depth map does not fit.
    """
    there, pitch = laid.there, laid.fit.grid.pitch
    normals = _normals(laid, facts, down=down)
    if depth_map:
        depth, facts["depth_map"] = guided(depth_map, laid.mask, laid.fit, normals, there)
    else:
        depth = integrate(normalmap.slopes_in(normals, there), there, pitch)
        facts["hidden_edges_mm"] = rim_length(normals, there, pitch)
    facts["depth_mm"] = float(np.ptp(depth[there]))
    return depth, normals


def _normals(laid: Laid, facts: Facts, *, down: bool) -> Floats:
    """Take unit normals on the grid; says which way their green points."""
    mask = laid.mask
    vectors = normalmap.vectors_of(laid.picture)
    way, by = (normalmap.DOWN, "setting") if down else normalmap.convention(vectors, mask)
    facing = mask & (vectors[..., 2] > 0)
    if facing.sum() < 0.5 * mask.sum():
        raise InputError(
            "most of these normals turn away from the viewer",
            expected="blue over half",
            found=f"{1 - facing.sum() / mask.sum():.0%} of the figure below",
            where=laid.picture.name,
        )
    facts |= {"green": way, "green_by": by}
    sampled = [laid.fit.field(np.nan_to_num(vectors[..., k]), mask) for k in range(3)]
    return normalmap.unit_normals(np.stack(sampled, -1), laid.there, way)
