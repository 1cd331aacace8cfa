"""Warm: everything that compiles, compiled before the first person waits for it."""

from collections.abc import Callable
from pathlib import Path

from relieffab.job.settings import default_job
from relieffab.layers.mesh import make_mesh
from relieffab.progress import Progress
from relieffab.studio.model import lightened
from relieffab.studio.preview import Preview
from relieffab.studio.trial import Trial

WIDTH = 64
COARSE = 2.0
"""Cells that the scarab is made of, mm."""


def steps() -> tuple[Callable[[Progress], None], ...]:
    """Give what is to be done, the most wanted first, so that others come in between.

    A coarse preview of a scarab, from nothing and from another; its panel; its programs.
    """
    from relieffab.subject import scarab

    mesh = make_mesh(*scarab(cell=COARSE), name="scarab", usual_up="y")
    model, preview = lightened(mesh, Path("scarab")), Preview(WIDTH)
    job = default_job(model="scarab", up="y")

    def relief(progress: Progress) -> None:
        for depth in ("3.2mm", "3mm"):
            deep = default_job(model="scarab", up="y", depth=depth)
            preview.relief(preview.view(model, deep, progress), deep, progress)

    def panel(progress: Progress) -> None:
        preview.panel(model, job, progress)

    def toolpaths(progress: Progress) -> None:
        solved = preview.relief(preview.view(model, job, progress), job, progress)
        Trial().carry_out(solved, job, progress)

    return relief, panel, toolpaths
