"""How much memory a job takes: by its stage, its resolution and its model's size."""

from pathlib import Path

from PIL import Image, UnidentifiedImageError

# Fitted from above to peaks of resident memory, from 256 x 192 to 2048 x 1536 pixels and
# from 1,280 to 1,310,720 triangles, in processes that had carried out jobs before.
BASE = {"layers": 0.4e9, "relief": 0.4e9, "make": 1.35e9}
PER_PIXEL = {"layers": 350.0, "relief": 350.0, "make": 280.0}
PER_TRIANGLE = 1700.0

PER_PICTURE_PIXEL = 70.0
"""Of the picture's own pixels, in colour."""
TRIANGLE = {".stl": 50, ".ply": 19, ".obj": 30, ".off": 30, ".glb": 18, ".3mf": 10}
"""Bytes of a file for each triangle, at least."""


def memory_of(stage: str, resolution: tuple[int, int], model: Path) -> int:
    """Estimate the memory of a job, bytes.

    Parameters
    ----------
    stage : str
        One of `relieffab.catalogue.identity.STAGES`.
    resolution : tuple of int
        Pixels across and down.
    model : Path
        One that is not there takes no memory of its own: the job fails at once.
    """
    pixels = resolution[0] * resolution[1]
    return int(BASE[stage] + PER_PIXEL[stage] * pixels + _of_model(model))


def _of_model(path: Path) -> float:
    """Estimate what a model takes, by its triangles or its pixels."""
    if not path.is_file():
        return 0.0
    try:
        with Image.open(path) as image:
            return PER_PICTURE_PIXEL * image.width * image.height
    except UnidentifiedImageError:
        return PER_TRIANGLE * path.stat().st_size / TRIANGLE.get(path.suffix.lower(), 50)
    except Image.DecompressionBombError:
        return 0.0  # refused at once
