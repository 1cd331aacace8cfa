"""Whether a program fits the machine as it stands, and what a person should know before."""

from dataclasses import dataclass

from relieffab.grbl.codes import error_meaning
from relieffab.grbl.controller import Controller
from relieffab.grbl.program import Program

_G = "0 1 2 3 4 10 17 18 19 20 21 28 28.1 30 30.1 38.2 38.3 38.4 38.5 40 43.1 49 53 54 55 56 57"
_G_TOO = "58 59 61 80 90 91 91.1 92 92.1 93 94"
_M = "0 1 2 3 4 5 8 9 30"
KNOWN = frozenset(
    {f"G{code}" for code in f"{_G} {_G_TOO}".split()} | {f"M{code}" for code in _M.split()}
)
"""What Grbl 1.1 understands; everything else is error 20 in the middle of the job."""

ROUNDING = 0.001
"""mm: the last digit of a reported offset."""


@dataclass(frozen=True)
class Review:
    """What was found before anything moved.

    Parameters
    ----------
    refusals : tuple of str
        Why the program must not be sent.
    notes : tuple of str
        What the person should know.
    """

    refusals: tuple[str, ...]
    notes: tuple[str, ...]


def review(program: Program, controller: Controller) -> Review:
    """Hold a program against the machine's own word.

    Without homing the machine's zero means nothing, so only the extent is compared with the
    travel, and that is noted: many small machines report a travel that is not theirs.
    """
    refusals: list[str] = []
    notes: list[str] = []
    if not controller.version.startswith("1.1"):
        refusals.append(f"the firmware is Grbl {controller.version or '?'}, not 1.1")
    if controller.settings.get(32, 0):
        refusals.append("laser mode is on ($32=1), which stops the spindle whenever no cut is made")
    refusals += _unknown(program, controller)
    found = misfits(program, controller)
    cleared = controller.cleared_by(program.codes)
    certain = program.bounds_certain and controller.soft_limits and not cleared
    (refusals if certain else notes).extend(found)
    notes += _spindle(program, controller)
    if still_over_axis(program):
        notes.append("the program never moves Y: the cutter has to stand right over the axis")
    if controller.homing and not any(controller.work_zero):
        notes.append("work zero is the machine's own zero: was it set?")
    return Review(tuple(refusals), tuple(notes))


def still_over_axis(program: Program) -> bool:
    """Say whether the work turns under a Y that the program leaves where it is."""
    return "A" in program.codes and program.bounds[0][1] is None


def _unknown(program: Program, controller: Controller) -> list[str]:
    """Find what would be refused in the middle of the job."""
    known = KNOWN | ({"M7"} if "M" in controller.options else set())
    if controller.axes > len("XYZ"):
        known |= {"A"}
    if controller.hal:
        known |= program.codes.keys() - {"A"}
    return [
        f"line {number}: {code} is error:20, {error_meaning(20)}"
        for code, number in program.codes.items()
        if code not in known
    ]


def misfits(program: Program, controller: Controller) -> list[str]:
    """Say where a program leaves the machine's travel.

    Returns
    -------
    list of str
        One sentence an axis; empty where it fits or nothing can be said.
    """
    found: list[str] = []
    travel, room = controller.travel, controller.room
    if travel is None or room is None:
        return found
    spans = zip("XYZA", *program.bounds, controller.work_zero, travel, *room, strict=False)
    for name, low, high, zero, whole, least, most in spans:
        if low is None or high is None or not whole:
            continue
        unit = "degrees" if name == "A" else "mm"
        if high - low > whole + ROUNDING:
            found.append(f"{name} spans {high - low:.3f} {unit} of {whole:.3f} {unit} of travel")
        elif (controller.homing or controller.soft_limits) and not (
            least - ROUNDING <= low + zero and high + zero <= most + ROUNDING
        ):
            found.append(
                f"{name} goes from {low + zero:.3f} to {high + zero:.3f} {unit} in machine "
                f"coordinates, the machine from {least:.3f} to {most:.3f}"
            )
    return found


def _spindle(program: Program, controller: Controller) -> list[str]:
    most = controller.settings.get(30)
    if not most or not program.speed:
        return []
    if program.speed > most:
        return [f"S{program.speed:g} is more than $30={most:g}: the spindle gets full power"]
    return []
