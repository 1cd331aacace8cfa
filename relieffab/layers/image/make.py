"""A picture to Layers: what `layers.make` is for a mesh."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.image import normalmap
from relieffab.layers.image.bands import repair
from relieffab.layers.image.edges import draw
from relieffab.layers.image.figure import find_figure
from relieffab.layers.image.fit import Fit, fit_on
from relieffab.layers.image.guide import guided
from relieffab.layers.image.ink import ink_layers
from relieffab.layers.image.integrate import integrate
from relieffab.layers.image.kind import check_shown, kind_of
from relieffab.layers.image.names import (
    DEPTH,
    DEPTH_FAR,
    DRAWING,
    NORMAL,
    NORMAL_DOWN,
    PHOTO,
)
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.rims import rim_length
from relieffab.layers.image.scale import to_length, white_is_far
from relieffab.layers.image.shape import brightness, shape_of
from relieffab.layers.image.steps import normals_of, slopes_of
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.image import line_image, spread_ink
from relieffab.layers.model import Layers
from relieffab.layers.shading import default_lights, lambert

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Facts = dict[str, Any]


DOUBTFUL = 0.75
"""Likeness of a depth map to its normals under which a person is told."""


@dataclass(frozen=True)
class Showing:
    """How a picture is meant.

    Parameters
    ----------
    kind : str or None
        One of `names.NAMES`; found from its values if not given.
    mask : str or None
        A mask's file, white where the figure is.
    deep : float or None
        Of a depth map, from its farthest to its nearest point as large as the
        figure stands on the panel, mm; half the figure's shorter side if not given.
    depth_map : str or None
        The file of a depth map that goes with a normal map.
    """

    kind: str | None = None
    mask: str | None = None
    deep: float | None = None
    depth_map: str | None = None


@dataclass(frozen=True, eq=False)
class Seen:
    """Layers of a picture, and what was found on the way.

    Parameters
    ----------
    layers : Layers
    fit : Fit
        Where the picture lies on the panel.
    facts : dict
        As report.json says them.
    """

    layers: Layers
    fit: Fit
    facts: Facts

    @property
    def notes(self) -> list[str]:
        """What a person should know of it."""
        found = [f"taken for a {self.facts['kind']}: --image says otherwise"]
        found = found if self.facts["kind_by"] == "values" else []
        if self.facts.get("mask"):
            found.append(f"the figure: by {self.facts['mask']}")
        bands = self.facts.get("banding")
        if bands:
            found.append(
                f"{bands['levels']} levels of {bands['step_mm']:.3f} mm smoothed within half a step"
            )
        hidden = self.facts.get("hidden_edges_mm", 0.0)
        if hidden > 0:
            found.append(
                f"{hidden:.0f} mm of edges behind which the figure may hide part of itself: how "
                "deep the step is there is a guess, for no normal tells; --depth-map would"
            )
        beside = self.facts.get("depth_map")
        if beside and beside["alike"] < DOUBTFUL:
            found.append(
                f"the depth map's slopes are like the normals' by {beside['alike']:.2f} of 1 only: "
                "it is noisy, or its greys are not even with depth"
            )
        if self.facts.get("light_fit", 1.0) < 0.3:
            found.append("its shading does not tell its form well: look at the relief")
        return found


def layers_of_picture(
    picture: Picture,
    grid: Grid,
    size: tuple[float, float],
    *,
    margin: float,
    showing: Showing | None = None,
    drawing: Drawing | None = None,
) -> Seen:
    """Take the three aligned images from a picture.

    Parameters
    ----------
    picture : Picture
    grid : Grid
    size : tuple of float
        The panel's X and Y, mm.
    margin : float
        Flat border round the figure, mm.
    showing : Showing, optional
    drawing : Drawing, optional

    Returns
    -------
    Seen

    Raises
    ------
    InputError
        If it shows nothing of the kind.
    """
    showing, drawing = showing or Showing(), drawing or Drawing()
    check_shown(picture)
    kind = showing.kind or kind_of(picture)
    facts: Facts = {"kind": kind, "kind_by": "setting" if showing.kind else "values"}
    if showing.depth_map and kind not in (NORMAL, NORMAL_DOWN):
        raise InputError(
            "--depth-map goes with a normal map alone",
            found=f"a picture taken for a {kind}",
            where=picture.name,
            hint="--image normal if it is one; a depth map alone is the model itself",
        )
    if kind == DRAWING:
        layers, fit = ink_layers(picture, grid, size, margin, drawing)
        return Seen(layers, fit, facts)
    mask, source = find_figure(picture, showing.mask, even=kind != PHOTO)
    fit = fit_on(mask, grid, size, margin=margin)
    there = fit.mask(mask)
    if not there.any():
        raise InputError("the figure is too small to be seen on the panel", where=picture.name)
    facts["mask"] = source
    grey = None
    if kind in (DEPTH, DEPTH_FAR):
        depth, normals = _of_depth(picture, mask, source, showing, fit, there, facts)
    elif kind == PHOTO:
        grey = fit.field(brightness(picture), mask)
        depth, normals = shape_of(grey, there, grid.pitch, facts)
    else:
        normals = _normals(picture, mask, kind, fit, there, facts)
        depth = _of_normals(normals, mask, showing, fit, there, facts)
    bare = _assemble(grid, depth, normals, there)
    strokes = draw(bare, drawing, grey)
    ink = line_image([s for s in strokes if not s.light], grid, width=drawing.width)
    lined = replace(bare, lines=spread_ink(ink, drawing.spread, grid), strokes=strokes)
    return Seen(lined, fit, facts)


def _assemble(grid: Grid, depth: Floats, normals: Floats, mask: Bools) -> Layers:
    lights = default_lights()
    return Layers(
        grid=grid,
        depth=np.where(mask, depth, 0.0),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=np.zeros(grid.shape),
    )


def _of_depth(
    picture: Picture,
    mask: Bools,
    source: str,
    showing: Showing,
    fit: Fit,
    there: Bools,
    facts: Facts,
) -> tuple[Floats, Floats]:
    """Depth on the grid and its normals; says what was found of levels and their order."""
    far, by = white_is_far(picture, mask, source)
    if showing.kind == DEPTH_FAR:
        far, by = True, "setting"
    grey = np.where(mask, picture.grey, 0.0)
    smooth, bands = repair(-grey if far else grey, mask)
    depth = fit.field(to_length(smooth, mask, fit.scale, showing.deep, picture.name), mask)
    facts |= {
        "near": "black" if far else "white",
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
    pitch = fit.grid.pitch
    return depth, normals_of(slopes_of(depth, there, pitch), there)


def _normals(
    picture: Picture, mask: Bools, kind: str, fit: Fit, there: Bools, facts: Facts
) -> Floats:
    """Take unit normals on the grid; says which way their green points."""
    vectors = normalmap.vectors_of(picture)
    way, by = normalmap.convention(vectors, mask)
    if kind == NORMAL_DOWN:
        way, by = normalmap.DOWN, "setting"
    facing = mask & (vectors[..., 2] > 0)
    if facing.sum() < 0.5 * mask.sum():
        raise InputError(
            "most of these normals turn away from the viewer",
            expected="blue over half",
            found=f"{1 - facing.sum() / mask.sum():.0%} of the figure below",
            where=picture.name,
        )
    facts |= {"green": way, "green_by": by}
    sampled = np.stack([fit.field(np.nan_to_num(vectors[..., k]), mask) for k in range(3)], -1)
    return normalmap.unit_normals(sampled, there, way)


def _of_normals(
    normals: Floats, mask: Bools, showing: Showing, fit: Fit, there: Bools, facts: Facts
) -> Floats:
    """Find the depth by integration, or with a depth map beside the normals."""
    pitch = fit.grid.pitch
    if showing.depth_map:
        if showing.deep is not None:
            raise InputError(
                "--image-depth says nothing of a depth map beside a normal map: its normals say it",
                where=showing.depth_map,
            )
        depth, facts["depth_map"] = guided(showing.depth_map, mask, fit, normals, there)
    else:
        depth = integrate(-np.moveaxis(normals[..., :2] / normals[..., 2:], 2, 0), there, pitch)
        facts["hidden_edges_mm"] = rim_length(normals, there, pitch)
    facts["depth_mm"] = float(np.ptp(depth[there]))
    return depth
