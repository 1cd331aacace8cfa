"""Programs that help to set a job up: the panel's outline in the air, and a probe of Z."""

from collections.abc import Iterator

import numpy as np

from relieffab.errors import InputError
from relieffab.gcode.header import commented, machine_words, turning_words, zero_words
from relieffab.gcode.limits import travel_findings
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup

FEED = 1500.0  # mm/min, slow enough to watch
REACH = 25.0  # mm down, within which the plate has to be
FAST, SLOW = 100.0, 25.0  # mm/min
BACK, AWAY = 2.0, 10.0  # mm up after the first touch, and at the end


def outline_program(setup: Setup) -> str:
    """Write a program that goes round the stock at the safe height, spindle off.

    It starts and ends above the near left corner: whoever watches sees whether the
    panel lies where work zero says, and whether clamps are in the way.  Of a panel cut
    part by part it goes round the part.

    Parameters
    ----------
    setup : Setup

    Raises
    ------
    InputError
        If the stock is larger than the machine's travel.
    """
    post, stock = setup.post, setup.stock
    high = post.length(setup.machine.safe_height - stock.work_zero[2])
    (x0, y0), (x1, y1) = setup.window
    corners = stock.to_work([(x, y, 0) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))])
    around = np.roll(corners, 2, axis=0) if stock.turned else corners
    around = np.concatenate([around, around[:1]])[:, :2]
    places = [
        f"X{post.number(x)} {post.across(y)}"
        for x, y in np.rint(around * post.scales[:2]).astype(int).tolist()
    ]
    rate = min(FEED, *setup.machine.max_rate[:2])
    feed, lengths = post.feed(rate), np.linalg.norm(np.diff(around, axis=0), axis=1)
    feeds = [post.inverse(rate, way) if post.turns else feed for way in lengths.tolist()]
    slow = f" F{feed}" if post.dialect.rapid_feed else ""
    rise = f" F{post.feed(setup.machine.max_rate[2])}" if post.dialect.rapid_feed else ""
    lines = [
        *_head(setup, "the panel's outline in the air, spindle off"),
        *_modes(setup, moving=True),
        "M5",
        f"G0 Z{high}{rise}",
        f"G0 {places[0]}{slow}",
        *(f"G1 {place} F{its}" for place, its in zip(places[1:], feeds, strict=True)),
        *(["G94"] if post.turns else []),
        post.dialect.end,
    ]
    text = "\n".join(lines) + "\n"
    read = read_program(text, name="outline", dialect=post.dialect, radius=stock.radius)
    points = read.points
    findings = travel_findings(points, setup.machine)
    if findings:
        raise InputError(
            "the panel does not fit on the machine's table",
            found="; ".join(findings),
            hint="a smaller size, or another machine",
        )
    return text


def probe_program(setup: Setup, plate: float) -> str:
    """Write a program that finds the stock's face with a touch plate and sets Z by it.

    The cutter has to stand above the plate, which lies on the face, by less than 25 mm.
    It touches twice, the second time slowly, and rises.

    Parameters
    ----------
    setup : Setup
    plate : float
        Its thickness, mm.
    """
    post, stock = setup.post, setup.stock
    if not 0 <= plate <= REACH:
        raise InputError(
            "the touch plate is not that thick",
            expected=f"0 to {REACH:g} mm",
            found=f"{plate:g} mm",
        )
    down, again, back, away = (
        post.number(int(np.rint(mm * post.per_mm))) for mm in (-REACH, -BACK - 1, BACK, AWAY)
    )
    here = post.number(int(np.rint((plate - stock.work_zero[2]) * post.per_mm)))
    touch, store = post.dialect.probe
    face = "the stock's face" + (", at its highest" if stock.curve else "")
    rise = f" F{post.feed(10 * FAST)}" if post.dialect.rapid_feed else ""
    lines = [
        *_head(setup, f"sets Z by a touch plate of {plate:g} mm on {face}, spindle off"),
        *_modes(setup),
        "M5",
        "G91",
        f"{touch} Z{down} F{post.feed(FAST)}",
        f"G0 Z{back}{rise}",
        f"{touch} Z{again} F{post.feed(SLOW)}",
        store.format(z=here),
        f"G0 Z{away}{rise}",
        "G90",
        post.dialect.end,
    ]
    return "\n".join(lines) + "\n"


def _head(setup: Setup, what: str) -> Iterator[str]:
    placing = () if setup.position is None else (setup.position.placing,)
    facts = [f"work zero: {zero_words(setup)}"]
    if setup.stock.radius:  # without these its A means nothing
        facts[:0] = [f"machine: {machine_words(setup)}", f"stock: {turning_words(setup)}"]
    for text in (what, *placing, *facts):
        yield from commented(text, setup)


def _modes(setup: Setup, *, moving: bool = False) -> list[str]:
    post = setup.post
    first, *rest = post.dialect.start or ("",)
    return [
        f"{post.units_word} G90 {first}".rstrip(),
        *(line.format(blend=post.blend()) for line in rest),
        *(["G93"] if moving and post.turns else []),
    ]
