"""Layers: the aligned images that a relief is made from."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Stroke:
    """One visible line of the drawing.

    Parameters
    ----------
    points : (n, 2) ndarray
        X and Y on the panel, mm.
    kind : str
        One of `layers.lines.names.NAMES`, or `DRAWN`.
    strength : (n,) ndarray
        0 (barely there) to 1.
    closed : bool
        Whether the last point joins the first.
    """

    points: Floats
    kind: str
    strength: Floats
    closed: bool = False

    @property
    def light(self) -> bool:
        """Whether it marks a highlight: drawn, but neither inked nor cut."""
        return self.kind.endswith("highlight")


@dataclass(frozen=True, eq=False)
class Layers:
    """What one view of a model tells, pixel by pixel; arrays are read-only.

    Parameters
    ----------
    grid : Grid
        The pixels' place on the panel.
    depth : (rows, cols) ndarray
        At pixel centres, mm, larger is nearer; 0 outside the figure.
    normals : (rows, cols, 3) ndarray
        Unit normals, X right, Y away from the operator, Z to the viewer.
    mask : (rows, cols) ndarray of bool
        The figure.
    lights : (k, 3) ndarray
        Unit vectors towards the lights.
    shading : (k, rows, cols) ndarray
        max(0, n·m) under each light, 0 to 1.
    lines : (rows, cols) ndarray
        Ink, 0 (none) to 1.
    strokes : tuple of Stroke
        The same lines as vectors.
    """

    grid: Grid
    depth: Floats
    normals: Floats
    mask: NDArray[np.bool_]
    lights: Floats
    shading: Floats
    lines: Floats
    strokes: tuple[Stroke, ...] = field(default=())

    def __post_init__(self) -> None:
        shape = self.grid.shape
        lights = len(self.lights)
        expected = {
            "depth": shape,
            "normals": (*shape, 3),
            "mask": shape,
            "lights": (lights, 3),
            "shading": (lights, *shape),
            "lines": shape,
        }
        for name, want in expected.items():
            array = getattr(self, name)
            if array.shape != want:
                raise InputError(
                    "the layers are not aligned",
                    expected=f"{name} of shape {want}",
                    found=f"{array.shape}",
                )
            if not np.isfinite(array).all():
                raise InputError(f"the layer {name} holds NaN or infinite values")
            array.flags.writeable = False
        if not self.mask.any():
            raise InputError(
                "the figure is empty: no pixel of the view shows the model",
                hint="another view, a larger size or a finer resolution",
            )

    @property
    def pitch(self) -> float:
        """Side of a pixel, mm."""
        return self.grid.pitch

    @property
    def level(self) -> bool:
        """Whether the figure has no form: all of it as near, and facing the viewer."""
        return bool(np.ptp(self.depth[self.mask]) == 0 and (self.normals[..., 2] == 1.0).all())
