"""The jobs of a batch, each with its name, its settings, and what it will take."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from relieffab.catalogue.identity import key_of
from relieffab.catalogue.lists import Wanted
from relieffab.catalogue.names import distinct_names
from relieffab.catalogue.needs import memory_of
from relieffab.errors import InputError
from relieffab.job.load import layered
from relieffab.job.settings import Chosen


@dataclass(frozen=True, eq=False)
class Entry:
    """A job of a batch.

    Parameters
    ----------
    name : str
        Of its folder; no two are alike.
    model, note : str
    settings : mapping of Chosen
        Empty where there is a fault.
    key : str
        From `relieffab.catalogue.identity.key_of`.
    memory : int
        What it will take, bytes, estimated.
    fault : str
        Why it cannot be begun.
    """

    name: str
    model: str
    note: str = ""
    settings: Mapping[str, Chosen] = field(default_factory=dict)
    key: str = ""
    memory: int = 0
    fault: str = ""


def entries(
    jobs: Sequence[Wanted], flags: Mapping[str, Any], environment: Mapping[str, str], stage: str
) -> list[Entry]:
    """Settle names and settings of jobs: flag > RELIEFFAB_* > list > job file > configuration.

    Raises
    ------
    InputError
        If flags, environment or user configuration cannot be read; what is wrong with one
        job is its `fault`.
    """
    layered(flags, environment, [])
    return [
        _entry(name, job, flags, environment, stage)
        for name, job in zip(distinct_names(jobs), jobs, strict=True)
    ]


def _entry(
    name: str, job: Wanted, flags: Mapping[str, Any], environment: Mapping[str, str], stage: str
) -> Entry:
    if job.fault:
        return Entry(name, job.model, job.note, fault=job.fault)
    try:
        settings = layered(flags, environment, job.files)
        if settings["model"].value is None:
            raise InputError("the job names no model", expected='model = "FILE"', where=job.where)
        key = key_of(settings)
        # A worker may stand elsewhere than the person does.
        model = Path(settings["model"].value).absolute()
    except InputError as fault:
        return Entry(name, job.model, job.note, fault=str(fault))
    memory = memory_of(stage, settings["resolution"].value, model)
    settings["model"] = replace(settings["model"], text=str(model), value=str(model))
    return Entry(name, job.model, job.note, settings, key, memory)
