"""What stands at the head of a program, in comments no controller acts on."""

import textwrap
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from math import pi

from relieffab import __version__
from relieffab.gcode.estimate import estimate
from relieffab.gcode.program import Program
from relieffab.gcode.setup import Setup
from relieffab.toolpath.path import Toolpath

_WIDTH = 77


def comments(
    paths: Sequence[Toolpath], program: Program, setup: Setup, more: Mapping[str, str]
) -> Iterator[str]:
    """Say what a program is, so that a person can check it and make it again."""
    for name, value in [*_facts(paths, program, setup).items(), *more.items()]:
        yield from commented(f"{name}: {value}", setup)


def commented(text: str, setup: Setup) -> Iterator[str]:
    """Write a sentence as comments of the setup's dialect, none too long for a line."""
    sign = setup.post.dialect.comments
    before, after = ("(", ")") if sign == "(" else ("; ", "")
    for part in textwrap.wrap(harmless(text), _WIDTH):
        yield f"{before}{part}{after}"


def _facts(paths: Sequence[Toolpath], program: Program, setup: Setup) -> dict[str, str]:
    machine, stock = setup.machine, setup.stock
    facts = {
        "relieffab": __version__,
        "program": ", ".join(path.name for path in paths),
    }
    for number, path in enumerate(paths, 1):
        cutter = path.cutter
        label = "cutter" if len(paths) == 1 else f"cutter T{number}"
        facts[label] = (
            f"{cutter.name}, {cutter.shape} {cutter.diameter:g} mm, {path.rpm:g} rpm, "
            f"at most {setup.limits(cutter).stepdown:.3g} mm a pass"
        )
    seconds = estimate(program, machine)
    low, high = program.bounds
    size = f"{stock.width:g} x {stock.height:g} x {stock.thickness:g} mm"
    if stock.curve:
        size += f", its face curved along X with a radius of {stock.curve:g} mm"
    return facts | {
        **_position(setup),
        "machine": machine_words(setup),
        "material": setup.material.title,
        "stock": turning_words(setup) or size,
        "work zero": zero_words(setup),
        "bounds, mm": "  ".join(
            f"{axis} {a:.3f} to {b:.3f}" for axis, a, b in zip("XYZ", low, high, strict=True)
        ),
        "time": f"{int(seconds // 60)} min {int(seconds % 60)} s",
    }


def machine_words(setup: Setup) -> str:
    """Say for which machine and controller a program is."""
    return f"{setup.machine.name}, {setup.post.dialect.title}"


def zero_words(setup: Setup) -> str:
    """Say where work zero is."""
    stock = setup.stock
    x, y, z = stock.work_zero
    corner = "the figure's top right" if stock.radius else "the near left corner"
    level = "the face's middle, its highest" if stock.curve else "the face"
    return f"X {x:g} Y {y:g} mm from {corner}, Z {z:g} mm from {level}"


def turning_words(setup: Setup) -> str:
    """Say how a round stock lies and which way it turns; nothing of a flat one."""
    stock, post = setup.stock, setup.post
    if not stock.radius:
        return ""
    turn = (
        "A turns the cutter about X against the work, right-handed, by inverse time"
        if post.turns
        else f"Y is mm round the face, {2 * pi * stock.radius:.3f} to a turn, in the way in "
        "which the cutter goes over the work"
    )
    return (
        f"round, {2 * stock.radius:g} mm thick, {stock.width:g} mm along X from the figure's top, "
        f"{turn}"
    )


def _position(setup: Setup) -> dict[str, str]:
    position = setup.position
    if position is None:
        return {}
    (x0, y0), (x1, y1) = setup.window
    return {
        "position": f"{position.number} of {position.count}, panel X {x0:g} to {x1:g} "
        f"Y {y0:g} to {y1:g} mm",
        "placing": position.placing,
    }


def harmless(text: str) -> str:
    """Bring a comment down to bytes no controller acts on.

    Grbl obeys `!`, `~`, `?` and every byte from 0x80 wherever they stand, and
    a comment ends at its first closing parenthesis.

    Examples
    --------
    >>> harmless("Säge (schnell!)")
    'Sage schnell'
    """
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    return "".join(c for c in plain if " " <= c <= "}" and c not in "!?()$%;")
