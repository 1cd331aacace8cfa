"""The depth map that is given with a normal map: read, compared with it, and joined to it."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.image.bands import repair
from relieffab.layers.image.figure import opaque
from relieffab.layers.image.fit import Fit
from relieffab.layers.image.fuse import fuse
from relieffab.layers.image.normalmap import slopes_in
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.read import read_picture
from relieffab.layers.image.scale import unit_of

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

ALIKE = 0.4
"""Likeness to the normals (see `unit_of`) under which a depth map is of something else."""
ENOUGH = 0.5
"""Share of the figure, at least, of which the depth map knows something."""


def guided(
    path: str, mask: Bools, fit: Fit, normals: Floats, there: Bools
) -> tuple[Floats, dict[str, Any]]:
    """Take the depth of a figure from its normals and a depth map of it.

    The normals say how long the map's unit is and which end of it is near.

    Parameters
    ----------
    path : str
        The depth map's file.
    mask : (rows, cols) ndarray of bool
        The figure, in the normal map's own pixels.
    fit : Fit
        Where these lie on the panel.
    normals : (rows, cols, 3) ndarray
        On the panel's grid.
    there : (rows, cols) ndarray of bool
        The figure there.

    Returns
    -------
    depth : (rows, cols) ndarray
        mm, the nearest point at 0; 0 outside the figure.
    facts : dict
        What was found of the depth map.

    Raises
    ------
    InputError
        If the depth map cannot be read, does not fit, or shows something else.
    """
    picture = read_picture(Path(path))
    known = _known(picture, mask, path)
    smooth, bands = repair(np.where(known, picture.grey, 0.0), known)
    values, sure = fit.field(smooth, known), there & fit.mask(known)
    pitch = fit.grid.pitch
    unit, alike = unit_of(values, sure, slopes_in(normals, there), pitch)
    if alike < ALIKE:
        raise InputError(
            "the depth map does not show what the normal map shows",
            expected="the same figure, seen the same way; grey that is even with depth",
            found=f"its slopes are like the normals' by {alike:.2f} of 1",
            where=path,
            hint="leave --depth-map out, or see that both are of one render",
        )
    doubt = 0.5 * abs(unit) * bands.step if bands else 0.0
    depth = fuse(unit * values, sure, normals, there, pitch, doubt=doubt)
    facts = {
        "file": picture.name,
        "bits": picture.bits,
        "near": "white" if unit > 0 else "black",
        "alike": alike,
        "known_share": float(sure.sum() / there.sum()),
    }
    return depth, facts


def _known(picture: Picture, mask: Bools, path: str) -> Bools:
    """Find where it knows something of the figure; refuse what cannot be its depth map."""
    if picture.shape != mask.shape:
        raise InputError(
            "the depth map does not fit the normal map",
            expected=f"{mask.shape[1]} x {mask.shape[0]} pixels",
            found=f"{picture.shape[1]} x {picture.shape[0]}",
            where=path,
            hint="scale it to that size, if it shows the same view",
        )
    if picture.coloured:
        raise InputError("a depth map has no colours", expected="grey", where=path)
    known = mask & opaque(picture)
    if known.sum() < ENOUGH * mask.sum():
        raise InputError(
            "the depth map knows too little of the figure",
            expected=f"{ENOUGH:.0%} of it",
            found=f"{known.sum() / mask.sum():.0%}",
            where=path,
        )
    if np.ptp(picture.grey[known]) == 0:
        raise InputError("the depth map is level", found="one grey in all of it", where=path)
    return known
