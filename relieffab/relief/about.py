"""What a file of heights says of itself: how large they are and where they lie."""

import json
import math
from dataclasses import dataclass

from relieffab.errors import InputError
from relieffab.relief.model import Relief

FORMAT = "relieffab relief 1"


@dataclass(frozen=True)
class About:
    """The size and place of a relief, without its heights.

    Parameters
    ----------
    pitch : float
        mm between nodes.
    origin : tuple of float
        X and Y of node [0, 0] on the panel, mm.
    depth : float
        Lower bound of the heights, positive, mm.
    """

    pitch: float
    origin: tuple[float, float]
    depth: float


def describe(relief: Relief, **more: float) -> str:
    """Write what `understand` reads, as JSON.

    Parameters
    ----------
    relief : Relief
    **more : float
        Other facts, for other programs.
    """
    return json.dumps(
        {
            "format": FORMAT,
            "pitch_mm": relief.grid.pitch,
            "origin_mm": list(relief.grid.origin),
            "depth_mm": relief.depth,
            **more,
        }
    )


def understand(text: str, where: str) -> About:
    """Read what `describe` wrote.

    Raises
    ------
    InputError
        If it is no description of ours, or does not say how large the relief is.
    """
    try:
        facts = json.loads(text)
    except ValueError:
        facts = text
    if not isinstance(facts, dict) or facts.get("format") != FORMAT:
        raise InputError(
            "this is not a relief of ours",
            expected=f"{FORMAT!r} in its description",
            found=repr(str(facts)[:80]),
            where=where,
        )
    try:
        x, y = (float(value) for value in facts["origin_mm"])
        about = About(float(facts["pitch_mm"]), (x, y), float(facts["depth_mm"]))
        if not (about.depth > 0 and all(map(math.isfinite, (x, y, about.pitch, about.depth)))):
            raise ValueError(text[:200])
    except (KeyError, TypeError, ValueError) as fault:
        raise InputError(
            "the relief does not say its size",
            expected="pitch_mm, origin_mm and depth_mm, the depth more than 0",
            found=repr(fault),
            where=where,
        ) from fault
    return about
