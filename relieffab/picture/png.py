"""Arrays to PNG bytes; where they go is for the caller to say."""

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from relieffab.errors import InputError


def _encode(image: Image.Image) -> bytes:
    buffer = io.BytesIO()
    image.save(buffer, format="PNG", compress_level=6)
    return buffer.getvalue()


def png8(image: NDArray[np.uint8]) -> bytes:
    """Encode an 8-bit picture.

    Parameters
    ----------
    image : (rows, cols) or (rows, cols, 3) ndarray of uint8

    Returns
    -------
    bytes
    """
    if image.dtype != np.uint8 or image.ndim not in (2, 3):
        raise InputError(
            "this is not an 8-bit picture",
            expected="uint8 of shape (rows, cols) or (rows, cols, 3)",
            found=f"{image.dtype} of shape {image.shape}",
        )
    return _encode(Image.fromarray(np.ascontiguousarray(image)))


def png_small(image: NDArray[np.uint8]) -> bytes:
    """Encode an 8-bit picture in 256 colours of its own: a third of the size.

    Parameters
    ----------
    image : (rows, cols, 3) ndarray of uint8

    Returns
    -------
    bytes
    """
    return _encode(Image.fromarray(np.ascontiguousarray(image)).quantize(256))


def png16(grey: NDArray[np.floating]) -> bytes:
    """Encode a grey picture at 16 bits, so that a height map shows no terraces.

    Parameters
    ----------
    grey : (rows, cols) ndarray
        0 (black) to 1 (white).

    Returns
    -------
    bytes
    """
    if grey.ndim != 2 or not (grey.min() >= 0 and grey.max() <= 1):
        raise InputError(
            "this is not a grey picture",
            expected="values from 0 to 1 in shape (rows, cols)",
            found=f"{grey.min():g} to {grey.max():g} in shape {grey.shape}",
        )
    return _encode(Image.fromarray(np.rint(grey * 65535).astype(np.uint16)))


def smaller(image: NDArray[np.uint8], width: int) -> NDArray[np.uint8]:
    """Shrink an 8-bit picture to a width, or leave it where it is no wider.

    Parameters
    ----------
    image : (rows, cols) or (rows, cols, 3) ndarray of uint8
    width : int
        Pixels.

    Returns
    -------
    ndarray of uint8
    """
    rows, cols = image.shape[:2]
    if cols <= width:
        return image
    size = width, max(1, round(rows * width / cols))
    return np.asarray(Image.fromarray(image).resize(size, Image.Resampling.LANCZOS))
