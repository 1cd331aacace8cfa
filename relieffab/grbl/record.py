"""What is kept of a job while it runs, so that it can be taken up again."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from relieffab.errors import InputError
from relieffab.grbl.messages import Point

SCHEMA = 1
RUNNING = "running"
"""The reason of a record that no end has replaced: the computer stopped, not the job."""


@dataclass(frozen=True)
class Record:
    """How far a job came.

    Parameters
    ----------
    program : str
        SHA-256 of the clean lines (`Program.digest`).
    line : int
        Line of the source to go on from: the first not known to be wholly cut.
    position : tuple of float or None
        Machine coordinates at which the machine was last seen, mm, A in degrees.
    work_zero : tuple of float
        Where work zero lay, machine coordinates, mm, A in degrees.
    position_kept : bool
        True where the machine was seen to stop without losing its position.
    reason : str
        What ended the job; `RUNNING` while it does not.
    """

    program: str
    line: int
    position: Point | None
    work_zero: Point
    position_kept: bool
    reason: str

    def to_dict(self) -> dict[str, Any]:
        """Give the record as plain data."""
        return {"schema": SCHEMA, **asdict(self)}


def from_dict(data: Mapping[str, Any]) -> Record:
    """Read a record back.

    Raises
    ------
    InputError
        If it is of another make, or damaged.
    """
    try:
        if data["schema"] != SCHEMA:
            raise InputError(
                "the record of the job is of another make",
                expected=f"schema {SCHEMA}",
                found=str(data["schema"]),
            )
        position = data["position"]
        return Record(
            program=str(data["program"]),
            line=int(data["line"]),
            position=None if position is None else _point(position),
            work_zero=_point(data["work_zero"]),
            position_kept=data["position_kept"] is True,
            reason=str(data["reason"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError("the record of the job is damaged", found=repr(error)) from error


def _point(values: Any) -> Point:
    x, y, z, *turn = (float(value) for value in values)
    return x, y, z, *turn
