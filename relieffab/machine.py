"""Machine and Material: what can move, how fast, and how willingly the stock is cut."""

from dataclasses import dataclass, replace
from math import inf, pi, radians

from relieffab.cutter import Cutter
from relieffab.errors import InputError


@dataclass(frozen=True)
class Rotary:
    """An axis that turns the work about the machine's X.

    Parameters
    ----------
    max_rate : float
        Degrees a minute.
    acceleration : float
        Degrees/s².
    diameter : float
        Largest work that it has room for, mm.
    """

    max_rate: float
    acceleration: float
    diameter: float

    def __post_init__(self) -> None:
        for name in ("max_rate", "acceleration", "diameter"):
            if not 0 < getattr(self, name) < inf:
                raise InputError(
                    f"the rotary axis cannot have a {name} of {getattr(self, name):g}",
                    expected="more than 0",
                )


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
    rotary : Rotary or None
        Where there is one; Grbl, which knows three axes, has it in place of Y.
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
    rotary: Rotary | None = None
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


def turning(machine: Machine, radius: float) -> Machine:
    """See a machine's rotary axis as a Y that goes round a face.

    Parameters
    ----------
    machine : Machine
    radius : float
        Of the face, mm.

    Returns
    -------
    Machine
        Its travel, rate and acceleration of Y are the rotary axis's, in mm on the face.

    Raises
    ------
    InputError
        If it has none, or no room for the work.
    """
    rotary = machine.rotary
    if rotary is None:
        raise InputError(
            f"the machine {machine.name} has no rotary axis",
            expected="[rotary] with max_rate, acceleration and diameter in its profile",
            where="round",
            hint="a --machine that has one, or a profile of yours; `relieffab panel` makes the "
            "solid without one",
        )
    if 2 * radius > rotary.diameter:
        raise InputError(
            f"the work is too thick for the rotary axis of {machine.name}",
            expected=f"a diameter of at most {rotary.diameter:g} mm",
            found=f"{2 * radius:g} mm",
            where="round",
        )
    (x, _, z), degree = machine.travel, radians(1) * radius
    return replace(
        machine,
        travel=(x, 2 * pi * radius + 1.0, z),
        max_rate=(machine.max_rate[0], rotary.max_rate * degree, machine.max_rate[2]),
        acceleration=(
            machine.acceleration[0], rotary.acceleration * degree, machine.acceleration[2],
        ),
    )  # fmt: skip


@dataclass(frozen=True)
class Use:
    """How one cutter is known to cut a material.

    Parameters
    ----------
    cutter : str
        Its key in machines/cutters.
    feed : float
        mm/min.
    source : str
        Where this is published, or who measured it.
    machines : tuple of str
        On which machines; any where there is none.
    plunge, rpm, stepdown : float
        mm/min, revolutions a minute, mm; 0 where they are as the factors say.
    """

    cutter: str
    feed: float
    source: str
    machines: tuple[str, ...] = ()
    plunge: float = 0.0
    rpm: float = 0.0
    stepdown: float = 0.0

    def __post_init__(self) -> None:
        if not (0 < self.feed < inf and min(self.plunge, self.rpm, self.stepdown) >= 0):
            raise InputError(
                f"feeds and speeds of {self.cutter} are out of range",
                expected="a feed of more than 0, the rest 0 or more",
                found=f"{self.feed:g}, {self.plunge:g}, {self.rpm:g}, {self.stepdown:g}",
            )
        if not self.source.strip():
            raise InputError(
                f"feeds and speeds of {self.cutter} have no source",
                expected="where they are published, or who measured them",
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
    use : tuple of Use
        What is known of single cutters, before the factors.
    """

    name: str
    title: str
    feed: float
    stepdown: float
    rpm: float = 1.0
    verified: bool = False
    source: str = ""
    note: str = ""
    use: tuple[Use, ...] = ()

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
    source : str
    verified : bool
        Whether that is a source for this cutter in this material, not a rule of thumb.
    """

    feed: float
    plunge: float
    rpm: float
    stepdown: float
    source: str = ""
    verified: bool = False


def known_use(cutter: Cutter, material: Material, machine: Machine) -> Use | None:
    """Find what is known of a cutter in a material: of this machine first, then of any."""
    found = [
        use
        for use in material.use
        if use.cutter == cutter.name and (machine.name in use.machines or not use.machines)
    ]
    return min(found, key=lambda use: not use.machines, default=None)


def cutting(cutter: Cutter, material: Material, machine: Machine) -> Cutting:
    """Take what is known of the cutter in the material, else scale its own values to it.

    All is capped at the machine's.

    Returns
    -------
    Cutting
        Feeds no machine axis would have to slow down for.
    """
    use = known_use(cutter, material, machine)
    slow, fast = machine.spindle
    feed = use.feed if use else cutter.feed * material.feed
    plunge = (use.plunge if use else 0.0) or min(cutter.plunge * material.feed, feed)
    rpm = (use.rpm if use else 0.0) or cutter.rpm * material.rpm
    turning = min(max(rpm, slow), fast)
    # A slower spindle wants a slower feed for the same chip; a faster one gets no more.
    feed *= min(1.0, turning / rpm) if use else 1.0
    return Cutting(
        feed=min(feed, *machine.max_rate[:2]),
        plunge=min(plunge, machine.max_rate[2]),
        rpm=turning,
        stepdown=(use.stepdown if use else 0.0) or cutter.stepdown * material.stepdown,
        source=use.source if use else material.source,
        verified=use is not None or material.verified,
    )
