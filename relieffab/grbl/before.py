"""Programs of our own that come before a job: the outline traced in the air, the Z probe."""

from relieffab.errors import InputError
from relieffab.grbl.program import Program, top

TRACE_FEED = 1000.0
"""mm or degrees a minute: slow enough to watch."""
HIGHEST_TOUCH = 25.0
"""mm the probe goes down at most before it gives up (ALARM:5)."""
FIRST_TOUCH, SECOND_TOUCH = 100.0, 20.0
"""mm/min: find the plate, then touch it again slowly enough to stop within microns."""
LIFT = 2.0
AWAY = 10.0
"""mm upwards between the touches, and at the end."""


def outline(program: Program) -> str:
    """Write the program that traces another one's bounds above the stock, spindle off.

    Raises
    ------
    InputError
        If the bounds are not known, or no height is that the program itself moves at.
    """
    (x0, y0, _, *a0), (x1, y1, _, *a1) = program.bounds
    second = "Y"
    if a0 and y0 is None:
        second, y0, y1 = "A", a0[0], a1[0]
    height = top(program)
    if x0 is None or y0 is None or x1 is None or y1 is None or not program.bounds_certain:
        raise InputError(
            "the outline of this program is not known",
            expected="X and Y in one work coordinate system",
            hint="trace it by hand",
        )
    if height <= 0:
        raise InputError(
            "the program never goes above Z0, so there is no safe height to trace it at",
            found=f"{height:g} mm at most",
        )
    corners = [(x1, y0), (x1, y1), (x0, y1), (x0, y0)]
    places = [f"X{x:.3f}{second}{y:.3f}" for x, y in [corners[-1], *corners]]
    lines = ["G17G21G90G94M5M9", f"G0Z{height:.3f}", f"G0{places[0]}", f"F{TRACE_FEED:g}"]
    return "\n".join([*lines, *(f"G1{place}" for place in places[1:])])


def touch(thickness: float) -> str:
    """Write the program that sets work zero's Z by a touch plate below the tool.

    Parameters
    ----------
    thickness : float
        Of the plate, which lies on the stock's face, mm.
    """
    if thickness < 0:
        raise InputError("a touch plate is not thinner than nothing", found=f"{thickness:g} mm")
    return "\n".join(
        [
            "G17G21G91G94M5M9",
            f"G38.2Z-{HIGHEST_TOUCH:g}F{FIRST_TOUCH:g}",
            f"G0Z{LIFT:g}",
            f"G38.2Z-{2 * LIFT:g}F{SECOND_TOUCH:g}",
            f"G10L20P0Z{thickness:.4f}",
            f"G0Z{AWAY:g}",
            "G90",
        ]
    )
