"""What a picture shows, told by its values."""

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.image.figure import opaque
from relieffab.layers.image.names import DEPTH, DRAWING, NORMAL, PHOTO
from relieffab.layers.image.picture import Picture

UNIT = 0.1
"""How far the length of a normal may be off in a normal map of 8 bits."""
TONE = 0.12
"""Share of the range of greys that is one tone of a drawing."""
TWO_TONED = 0.9
"""Share of a drawing's pixels that are nearly its darkest or its lightest."""


def check_shown(picture: Picture) -> None:
    """Refuse a picture that shows nothing.

    Raises
    ------
    InputError
        If no pixel is opaque and a number, or all are alike.
    """
    values = picture.values[opaque(picture)]
    if not len(values):
        raise InputError(
            "the picture shows nothing",
            expected="pixels that are opaque, and numbers",
            found="all transparent, NaN or infinite",
            where=picture.name,
        )
    if picture.alpha is None and np.ptp(values, axis=0).max() == 0:
        raise InputError(
            "the picture is all of one colour: it shows nothing",
            found=f"{picture.shape[1]} x {picture.shape[0]} pixels alike",
            where=picture.name,
        )


def kind_of(picture: Picture) -> str:
    """Guess what a picture shows.

    Colours that are unit vectors are normals; two tones with hardly anything between
    are a drawing; one channel of floating point or 16 bits is a depth map; what is
    left is a photograph.  A grey picture of 8 bits may be either: see `--image`.

    Returns
    -------
    str
        One of `names.KINDS`.
    """
    values = picture.values[opaque(picture)]
    if picture.coloured:
        return NORMAL if _unit_vectors(values, picture.bits) else PHOTO
    if picture.bits is None:
        return DEPTH
    grey = picture.grey[opaque(picture)]
    low, high = np.percentile(grey, (0.1, 99.9))
    tone = TONE * max(high - low, 1e-9)
    toned = (np.minimum(grey - low, high - grey) < tone).mean() >= TWO_TONED
    if picture.bits > 8:  # a map's figure may be two-toned on black, but hardly on white
        return DRAWING if toned and np.median(grey) > high - tone else DEPTH
    return DRAWING if toned else PHOTO


def _unit_vectors(values: NDArray[np.float64], bits: int | None) -> bool:
    """Whether most colours are unit vectors that face the viewer."""
    stored = bits is None and values.min() < -0.01
    vectors = values if stored else 2.0 * values - 1.0
    length = np.linalg.norm(vectors, axis=1)
    marked = np.ptp(values, axis=1) > 0.02  # a grey background is none
    if marked.mean() < 0.02:
        return False
    fit = np.abs(length[marked] - 1.0) < UNIT
    return bool(fit.mean() > 0.8 and np.median(vectors[marked, 2]) > 0.0)
