"""Ask: what a person looks at."""

from dataclasses import dataclass

from relieffab.job.settings import Job
from relieffab.studio.model import Model
from relieffab.studio.sheet import Sheet


@dataclass(frozen=True)
class Ask:
    """A model, its mask if it has one, and the settings for it."""

    model: Model | Sheet
    job: Job
    mask: Sheet | None = None
