"""What makes one job the same as another: so that nothing finished is made again."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

from relieffab import __version__, profiles
from relieffab.errors import InputError
from relieffab.job.folder import REPORT
from relieffab.job.load import FILES
from relieffab.job.report import Report, read_report
from relieffab.job.settings import Chosen, Job, job_of

STAGES = ("layers", "relief", "make")
"""What a batch may go as far as, each including those before it."""


def key_of(settings: Mapping[str, Chosen]) -> str:
    """Hash all that decides a job's result but the model's own bytes.

    That is the version, the values of the settings, however they were typed, what the
    profiles hold that they name, and what is in a mask and a depth map.

    Returns
    -------
    str
        SHA-256.

    Raises
    ------
    InputError
        If the settings do not go together, or name a profile that is not there.
    """
    job = job_of(settings)
    values = [(name, choice.value) for name, choice in settings.items() if name not in FILES]
    files = (getattr(job, name) for name in FILES if name != "model")
    beside = [_hash(Path(path)) if path else None for path in files]
    told = repr((__version__, values, _profiles(job), beside))
    return hashlib.sha256(told.encode()).hexdigest()


def _profiles(job: Job) -> list[object]:
    cutters = [profiles.cutter(name) for name in (job.rough, job.finish, job.lines)]
    return [profiles.machine(job.machine), profiles.material(job.material), *cutters]


def finished(folder: Path, stage: str, key: str, model: Path) -> Report | None:
    """Return the report of a job that was finished in a folder, at least to a stage.

    Parameters
    ----------
    folder : Path
    stage : str
        One of `STAGES`.
    key : str
        From `key_of`.
    model : Path
        Its bytes are compared with those that were carved.

    Returns
    -------
    dict or None
        None where the job is still to be done, or done anew.
    """
    if not (folder / REPORT).is_file():
        return None
    try:
        report = read_report(folder)
    except InputError:
        return None  # not one of ours any more: the job writes another
    batch = report.get("batch", {})
    as_far = batch.get("stage") in STAGES[STAGES.index(stage) :]
    same = as_far and batch.get("key") == key
    return report if same and report["model"].get("sha256") == _hash(model) else None


def _hash(path: Path) -> str | None:
    if not path.is_file():
        return None
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
