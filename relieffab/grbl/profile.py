"""A machine's profile out of what it prints when asked `$$`."""

from collections.abc import Iterable

from relieffab.errors import InputError
from relieffab.grbl.controller import Controller
from relieffab.grbl.messages import Note, Setting, parse

_NEEDED = {
    **{110 + axis: f"top rate of {'XYZ'[axis]}" for axis in range(3)},
    **{120 + axis: f"acceleration of {'XYZ'[axis]}" for axis in range(3)},
    **{130 + axis: f"travel of {'XYZ'[axis]}" for axis in range(3)},
    30: "fastest spindle",
}


def read_dump(lines: Iterable[str]) -> Controller:
    """Read a dump of `$$`, and of `$I` if it is there too.

    Raises
    ------
    InputError
        If settings that a profile needs are missing.
    """
    controller = Controller()
    for line in lines:
        message = parse(line.strip())
        if isinstance(message, (Setting, Note)):
            controller.learn(message)
    missing = [f"${number} ({what})" for number, what in _NEEDED.items()
               if number not in controller.settings]  # fmt: skip
    if missing:
        raise InputError(
            "this is not a whole dump of Grbl's settings",
            expected="the answer to $$",
            found="no " + ", ".join(missing),
        )
    return controller


def to_toml(controller: Controller, title: str) -> str:
    """Write the profile of a machine.

    Parameters
    ----------
    controller : Controller
        From `read_dump`, or a machine that was asked.
    title : str
        For people.

    Returns
    -------
    str
        A file for machines/machines.
    """
    settings = controller.settings

    def axes(first: int) -> str:
        return "[" + ", ".join(f"{settings[first + axis]:g}" for axis in range(3)) + "]"

    slow, fast = settings.get(31, 0.0), settings[30]
    quoted = title.replace("\\", "\\\\").replace('"', '\\"')
    return "\n".join(
        [
            f'title = "{quoted}"',
            f"travel = {axes(130)}",
            f"max_rate = {axes(110)}",
            f"acceleration = {axes(120)}",
            f"junction_deviation = {settings.get(11, 0.01):g}",
            "# $30 need not be the true speed: many machines are shipped with 1000.",
            f"spindle = [{slow:g}, {fast:g}]",
            f"spindle_max_setting = {fast:g}",
            f"rx_buffer = {controller.buffer}",
            f"planner_blocks = {controller.blocks}",
            f"line_rate = {controller.limits.line_rate:g}",
            'source = "the settings of the machine itself ($$)"',
            "",
        ]
    )
