"""The small picture by which a job is found again."""

import io
from pathlib import Path

import numpy as np
from PIL import Image

THUMBNAIL = "thumbnail.jpg"
PICTURES = ("preview.png", "layers/lambert.png")
WIDTH = 480  # pixels: sharp at twice the density on the catalogue's cards


def thumbnail(folder: Path) -> bytes:
    """Shrink the picture that a job left, as a JPEG file."""
    file = next(folder / name for name in PICTURES if (folder / name).is_file())
    with Image.open(file) as image:
        grey = image.mode.startswith("I")
        shown = Image.fromarray((np.asarray(image) >> 8).astype(np.uint8)) if grey else image
        small = shown.convert("RGB")
    small.thumbnail((WIDTH, WIDTH), Image.Resampling.LANCZOS)
    buffer = io.BytesIO()
    small.save(buffer, format="JPEG", quality=85, optimize=True)
    return buffer.getvalue()
