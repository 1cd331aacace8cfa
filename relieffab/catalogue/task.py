"""A job as it is handed to whoever carries it out, and what comes back."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from relieffab.job.report import Report
from relieffab.job.settings import Chosen


@dataclass(frozen=True, eq=False)
class Task:
    """A job to be carried out, on this machine or another.

    Parameters
    ----------
    name : str
        Of its folder in the catalogue.
    settings : mapping of Chosen
    stage : str
        How far it goes: one of `relieffab.catalogue.identity.STAGES`.
    key : str
        What it must come to, from `key_of`.
    catalogue : Path
        The folder of all jobs, absolute.
    token : str
        Of the batch: what its lock holds.
    memory : int
        What it takes, bytes, estimated.
    """

    name: str
    settings: Mapping[str, Chosen]
    stage: str
    key: str
    catalogue: Path
    token: str
    memory: int

    @property
    def folder(self) -> Path:
        """Where the job's files go."""
        return self.catalogue / self.name

    @property
    def model(self) -> Path:
        """The model's file."""
        return Path(self.settings["model"].value)


@dataclass(frozen=True)
class Fault:
    """Why a job was not done.

    Parameters
    ----------
    message : str
        For the person, with what to do.
    trace : str
        For whoever repairs the program, where the fault is its own.
    """

    message: str
    trace: str = ""


Result = Report | Fault
Work = Callable[[Task], Result]
