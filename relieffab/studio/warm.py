"""Warm: everything that compiles, compiled before the first person waits for it."""

from pathlib import Path

from relieffab.job.settings import default_job
from relieffab.layers.mesh import make_mesh
from relieffab.progress import Progress
from relieffab.studio.model import lightened
from relieffab.studio.preview import Preview
from relieffab.studio.trial import Trial


def warm(progress: Progress) -> None:
    """Make a coarse preview of a scarab, twice over, its panel and its programs."""
    from relieffab.subject import scarab

    model = lightened(make_mesh(*scarab(), name="scarab", usual_up="y"), Path("scarab"))
    preview = Preview(width=64)
    for depth in ("3mm", "3.2mm"):
        job = default_job(model="scarab", up="y", depth=depth)
        solved = preview.relief(preview.view(model, job, progress), job, progress)
    preview.panel(model, job, progress)
    Trial().carry_out(solved, job, progress)
