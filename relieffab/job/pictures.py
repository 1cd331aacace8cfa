"""The pictures of a job's relief and solids."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.job.settings import Job
from relieffab.layers.shading import light_at
from relieffab.panel.model import Panel
from relieffab.picture import panel_picture, png8, smaller, solid_picture, standing_picture
from relieffab.relief.model import Relief
from relieffab.round import Curved, Round

Part = dict[str, Any]

THUMBNAIL = 512  # pixels wide


def write_picture(
    relief: Relief,
    panel: Panel | None,
    job: Job,
    folder: Path,
    bent: Round | Curved | None = None,
) -> tuple[bytes, Part]:
    """Write preview.png; return it small, and how it was made.

    Parameters
    ----------
    relief : Relief
    panel : Panel or None
        Without one, the picture shows the relief.
    job : Job
    folder : Path
    bent : Round or Curved, optional
        The stock that the panel is carved from, where it is not flat.
    """
    file, light = folder / "preview.png", light_at(*job.light)
    if panel is not None and isinstance(bent, Round):
        return _kept(
            standing_picture(panel, light=light, texture=job.texture), "orthographic", file
        )
    if panel is not None and bent is not None:
        picture = solid_picture(panel, relief.grid.pitch, light=light, texture=job.texture)
    else:
        picture = panel_picture(relief, panel, light=light, texture=job.texture)
    return _kept(*picture, file)


def write_solid_picture(solid: Panel, relief: Relief, job: Job, file: Path) -> tuple[bytes, Part]:
    """Write the picture of a plaque or a mould; return it small, and how it was made."""
    pitch, light = relief.grid.pitch, light_at(*job.light)
    return _kept(*solid_picture(solid, pitch, light=light, texture=job.texture), file)


def _kept(image: NDArray[np.uint8], method: str, file: Path) -> tuple[bytes, Part]:
    file.write_bytes(png8(image))
    return png8(smaller(image, THUMBNAIL)), {"file": file.name, "method": method}
