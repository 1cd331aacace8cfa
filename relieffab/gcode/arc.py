"""Arcs in the XY plane as chords."""

from math import acos, atan2, ceil, cos, hypot, pi, sin, sqrt

from relieffab.gcode.words import refused

CHORD_ERROR = 0.0005  # mm a chord may lie inside its arc

Point = tuple[float, float, float]


def centre_from_radius(
    start: Point, end: Point, radius: float, clockwise: bool, where: str
) -> tuple[float, float]:
    """Find the centre of an arc given as R, relative to its start, mm.

    A negative radius asks for the arc longer than half a turn.
    """
    x, y = end[0] - start[0], end[1] - start[1]
    chord = hypot(x, y)
    if chord == 0:
        raise refused(33, where, "the arc ends where it starts")
    off2 = radius * radius - chord * chord / 4
    if off2 < 0:
        raise refused(34, where, f"R {radius:g} mm for a chord of {chord:g} mm")
    # The centre lies right of the chord for a short clockwise arc.
    off = sqrt(off2) / chord * (1 if clockwise == (radius > 0) else -1)
    return x / 2 + y * off, y / 2 - x * off


def chords(
    start: Point, end: Point, offset: tuple[float, float], clockwise: bool, where: str
) -> list[Point]:
    """Cut an arc or helix into chords.

    Parameters
    ----------
    start, end : tuple of float
        mm.  A whole turn where they meet in X and Y.
    offset : tuple of float
        Centre relative to the start, mm.
    clockwise : bool
    where : str
        File and line, for messages.

    Returns
    -------
    list of tuple of float
        Points after the start, the end last.
    """
    cx, cy = start[0] + offset[0], start[1] + offset[1]
    radius, end_radius = hypot(*offset), hypot(end[0] - cx, end[1] - cy)
    miss = abs(radius - end_radius)
    if miss > 0.5 or miss > max(0.005, 0.001 * radius):
        raise refused(33, where, f"radii {radius:.4f} and {end_radius:.4f} mm")
    first = atan2(-offset[1], -offset[0])
    x, y = end[0] - cx, end[1] - cy
    sweep = atan2(-offset[0] * y + offset[1] * x, -offset[0] * x - offset[1] * y)
    if clockwise and sweep >= -5e-7:
        sweep -= 2 * pi
    elif not clockwise and sweep <= 5e-7:
        sweep += 2 * pi
    widest = 2 * acos(max(1 - CHORD_ERROR / radius, 0.0)) if radius > 0 else pi
    count = max(1, ceil(abs(sweep) / widest))
    points = []
    for k in range(1, count):
        t = k / count
        angle = first + sweep * t
        r = radius + (end_radius - radius) * t
        z = start[2] + (end[2] - start[2]) * t
        points.append((cx + r * cos(angle), cy + r * sin(angle), z))
    return [*points, end]
