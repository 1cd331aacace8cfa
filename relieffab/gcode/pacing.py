"""Paths simplified until their lines keep a machine fed, and no further."""

from dataclasses import dataclass

from relieffab.gcode.estimate import Pace, pace
from relieffab.gcode.program import Program
from relieffab.gcode.setup import Setup
from relieffab.gcode.write import foretold
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.simplify import thin

TOLERANCES = (0.0, 0.002, 0.004, 0.007, 0.01)
"""Tried in turn, mm; coarser ones make corners sharper, so that machines brake again."""

STARVED = 0.05
"""Share of the time lost for want of lines, above which a program is said to starve."""


@dataclass(frozen=True)
class Paced:
    """A toolpath fit for its machine.

    Parameters
    ----------
    path : Toolpath
    tolerance : float
        By which it was simplified, upwards only, mm.
    pace : Pace
    program : Program
        The path as it would be written.
    """

    path: Toolpath
    tolerance: float
    pace: Pace
    program: Program

    @property
    def warning(self) -> str:
        """What a person should know; empty where the machine is kept fed."""
        if self.pace.starved <= STARVED:
            return ""
        return (
            f"{self.path.name}: {self.pace.starved:.0%} of the time is lost because the controller "
            "sees too few moves ahead; a coarser stepover, a lower feed, or a controller that "
            "looks further ahead would not starve"
        )


def paced(path: Toolpath, setup: Setup) -> Paced:
    """Simplify a toolpath by the least tolerance that does not starve the machine.

    Where all of them do, the fastest is taken.

    Parameters
    ----------
    path : Toolpath
    setup : Setup
    """
    tried: list[Paced] = []
    for tolerance in TOLERANCES:
        thinner = thin(path, tolerance)
        program = foretold(thinner, setup)
        found = Paced(thinner, tolerance, pace(program, setup.machine), program)
        if found.pace.starved <= STARVED:
            return found
        tried.append(found)
    return min(tried, key=lambda one: one.pace.seconds)
