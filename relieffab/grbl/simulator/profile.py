"""One move's speed over time: accelerate, cruise, decelerate."""

import math


class Profile:
    """Speed over `distance` from `entry` to `leave`, never above `nominal`.

    Parameters
    ----------
    distance : float
        mm.
    entry, leave, nominal : float
        Speeds at the start, the end and at most in between, mm/s.
    acceleration : float
        mm/s².

    Attributes
    ----------
    seconds : float
    leave : float
        Speed at the end as it can be reached.
    """

    __slots__ = ("acceleration", "distance", "entry", "first", "leave", "peak", "second", "seconds")

    def __init__(
        self, distance: float, entry: float, leave: float, nominal: float, acceleration: float
    ) -> None:
        entry2, room = entry * entry, 2.0 * acceleration * distance
        if leave * leave > entry2 + room:
            leave = math.sqrt(entry2 + room)
        elif leave * leave < entry2 - room:
            leave = math.sqrt(entry2 - room)
        leave2 = leave * leave
        peak = math.sqrt((entry2 + leave2 + room) / 2.0)
        if peak > nominal:
            peak = nominal if nominal > leave else leave
        peak2 = peak * peak
        left = room - abs(peak2 - entry2) - (peak2 - leave2)
        self.first = abs(peak - entry) / acceleration
        self.second = self.first
        if left > 0.0 and peak > 0.0:
            self.second += left / (2.0 * acceleration * peak)
        self.seconds = self.second + (peak - leave) / acceleration
        self.entry, self.peak, self.leave = entry, peak, leave
        self.distance, self.acceleration = distance, acceleration

    def at(self, time: float) -> tuple[float, float]:
        """Distance covered (mm) and speed (mm/s) `time` seconds after the start."""
        if time >= self.seconds:
            return self.distance, self.leave
        if time < self.first:
            slope = self.acceleration if self.peak >= self.entry else -self.acceleration
            speed = self.entry + slope * time
            return (self.entry + speed) / 2.0 * time, speed
        covered = (self.entry + self.peak) / 2.0 * self.first
        if time < self.second:
            return covered + self.peak * (time - self.first), self.peak
        speed = self.leave + self.acceleration * (self.seconds - time)
        left = (speed + self.leave) / 2.0 * (self.seconds - time)
        return self.distance - left, speed
