"""Machine and Material: what can move, how fast, and how willingly the stock is cut."""

from dataclasses import dataclass
from math import inf

from relieffab.cutter import Cutter
from relieffab.errors import InputError


@dataclass(frozen=True)
class Machine:
    """A machine as its firmware has it set.

    Parameters
    ----------
    name, title : str
        Key in machines/machines, and words for people.
    travel : tuple of float
        X, Y, Z the machine can move, mm.
    max_rate : tuple of float
        Per axis, mm/min ($110-$112).
    acceleration : tuple of float
        Per axis, mm/s² ($120-$122).
    spindle : tuple of float
        Slowest and fastest true speed, rpm.
    spindle_max_setting : float
        The controller's $30, which need not be the true rpm.
    safe_height : float
        Z of moves across the panel, mm above its face.
    junction_deviation : float
        $11, mm.
    rx_buffer : int
        Bytes the controller takes before it answers.
    planner_blocks : int
        Moves the controller looks ahead.
    line_rate : float
        Lines of G-code it parses a second.
    baud : float
        Bits a second of its serial line, ten to a character.
    dialect : str
    source : str
        Where these values come from.
    """

    name: str
    title: str
    travel: tuple[float, float, float]
    max_rate: tuple[float, float, float]
    acceleration: tuple[float, float, float]
    spindle: tuple[float, float]
    spindle_max_setting: float
    safe_height: float = 5.0
    junction_deviation: float = 0.01
    rx_buffer: int = 128
    planner_blocks: int = 15
    line_rate: float = 400.0
    baud: float = 115200.0
    dialect: str = "grbl"
    source: str = ""

    def __post_init__(self) -> None:
        for name in ("travel", "max_rate", "acceleration"):
            value = getattr(self, name)
            if min(value) <= 0:
                raise InputError(
                    f"{name} must be more than 0 on every axis",
                    found=f"{value}",
                    where=f"machine {self.name}",
                )
        slow, fast = self.spindle
        if not 0 <= slow <= fast or fast <= 0:
            raise InputError(
                "the spindle's speeds are out of order",
                expected="slowest and fastest, from 0 up",
                found=f"{slow:g} to {fast:g} rpm",
                where=f"machine {self.name}",
            )
        for name in ("planner_blocks", "line_rate", "baud", "junction_deviation"):
            if not 0 < getattr(self, name) < inf:
                raise InputError(
                    f"{name} must be more than 0",
                    found=f"{getattr(self, name)}",
                    where=f"machine {self.name}",
                )
        if self.safe_height <= 0:
            raise InputError(
                "the safe height must lie above the panel's face",
                expected="more than 0 mm",
                found=f"{self.safe_height} mm",
                where=f"machine {self.name}",
            )


@dataclass(frozen=True)
class Material:
    """How a stock is cut, relative to softwood.

    Parameters
    ----------
    name, title : str
    feed, stepdown, rpm : float
        Factors on the cutter's own values.
    verified : bool
        False where no measured source for the values is known.
    source, note : str
    """

    name: str
    title: str
    feed: float
    stepdown: float
    rpm: float = 1.0
    verified: bool = False
    source: str = ""
    note: str = ""

    def __post_init__(self) -> None:
        for name in ("feed", "stepdown", "rpm"):
            if not 0 < getattr(self, name) <= 2:
                raise InputError(
                    f"the factor {name} cannot be {getattr(self, name)}",
                    expected="more than 0, at most 2",
                    where=f"material {self.name}",
                )


@dataclass(frozen=True)
class Cutting:
    """One cutter at work in one material on one machine.

    Parameters
    ----------
    feed, plunge : float
        mm/min.
    rpm : float
    stepdown : float
        Deepest single pass, mm.
    """

    feed: float
    plunge: float
    rpm: float
    stepdown: float


def cutting(cutter: Cutter, material: Material, machine: Machine) -> Cutting:
    """Scale the cutter's values to the material and cap them at the machine's.

    Returns
    -------
    Cutting
        Feeds no machine axis would have to slow down for.
    """
    slow, fast = machine.spindle
    return Cutting(
        feed=min(cutter.feed * material.feed, *machine.max_rate[:2]),
        plunge=min(cutter.plunge * material.feed, machine.max_rate[2]),
        rpm=min(max(cutter.rpm * material.rpm, slow), fast),
        stepdown=cutter.stepdown * material.stepdown,
    )
