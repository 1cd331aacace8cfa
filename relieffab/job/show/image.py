"""Pictures of any kind, at eight bits."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from relieffab.errors import InputError
from relieffab.job.show.shown import Shown


def read_image(path: Path) -> NDArray[np.uint8]:
    """Read a picture at eight bits.

    Returns
    -------
    (rows, cols) or (rows, cols, 3) ndarray of uint8

    Raises
    ------
    InputError
        If there is none, or it is no picture.
    """
    try:
        with Image.open(path) as image:
            image.load()
            if image.mode.startswith("I"):
                return (np.asarray(image).astype(np.uint32) >> 8).astype(np.uint8)
            return np.asarray(image.convert("L" if image.mode in ("1", "L") else "RGB"))
    except FileNotFoundError:
        raise InputError("there is no such picture", where=str(path)) from None
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as fault:
        raise InputError(
            "the picture cannot be read", found=str(fault)[:200], where=str(path)
        ) from fault


def show_image(path: Path) -> Shown:
    """Show a picture as it is."""
    image = read_image(path)
    return Shown("picture", {"pixels": [image.shape[1], image.shape[0]]}, image)
