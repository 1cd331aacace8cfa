"""Warm: everything that compiles, compiled before the first person waits for it."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from relieffab.job.settings import default_job
from relieffab.layers.image.picture import Picture
from relieffab.layers.mesh import make_mesh
from relieffab.progress import Progress
from relieffab.studio.ask import Ask
from relieffab.studio.model import lightened
from relieffab.studio.preview import Preview
from relieffab.studio.sheet import sheet_of_picture
from relieffab.studio.trial import Trial

WIDTH = 64
COARSE = 2.0
"""Cells that the scarab is made of, mm."""
MARKED = {
    **{"size": "40x30mm", "margin": "3mm", "style": "point", "ground": "pecked"},
    **{"mark_spacing": "2mm", "mark_depth": "0.9mm"},
}
"""Marks that few pixels show."""


def steps() -> tuple[Callable[[Progress], None], ...]:
    """Give what is to be done, the most wanted first, so that others come in between.

    A coarse preview of a scarab, from nothing and from another; its panel; its programs;
    a picture of it, as a map and as a photograph; marks.
    """
    from relieffab.subject import scarab

    mesh = make_mesh(*scarab(cell=COARSE), name="scarab", usual_up="y")
    model, preview = lightened(mesh, Path("scarab")), Preview(WIDTH)
    job = default_job(model="scarab", up="y")

    def relief(progress: Progress) -> None:
        for depth in ("3.2mm", "3mm"):
            deep = default_job(model="scarab", up="y", depth=depth)
            preview.relief(preview.view(Ask(model, deep), progress), deep, progress)

    def panel(progress: Progress) -> None:
        preview.panel(Ask(model, job), progress)

    def toolpaths(progress: Progress) -> None:
        solved = preview.relief(preview.view(Ask(model, job), progress), job, progress)
        Trial().carry_out(solved, job, progress)

    def pictures(progress: Progress) -> None:
        layers = preview.view(Ask(model, job), progress).layers
        near = layers.depth / np.ptp(layers.depth)
        grey = np.where(layers.mask, np.rint(250 * (near - near.min()) + 5), 0.0) / 255
        flat = Picture(grey[..., None], None, 8, "PNG", "scarab.png")
        sheet = sheet_of_picture(flat, Path("scarab.png"))
        for image in ("depth", "photo"):
            shown = default_job(model="scarab.png", image=image)
            Preview(WIDTH).view(Ask(sheet, shown), progress)

    def marks(progress: Progress) -> None:
        marked = default_job(model="scarab", up="y", **MARKED)
        fine = Preview(WIDTH, whole=True)
        fine.marked(fine.view(Ask(model, marked), progress), marked, progress)

    return relief, panel, toolpaths, pictures, marks
