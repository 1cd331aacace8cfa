"""Faults on demand: a noisy line, and what else goes wrong with machines and cables.

sim://?flip=1e-4&drop=1e-4&seed=7   bytes altered and lost, both ways, always the same ones
sim://?unplug_at=3                  the cable is pulled 3 s after the port was opened
sim://?reboot_at=3                  the controller restarts
sim://?limit_at=3                   a limit switch is hit (ALARM:1)
sim://?door_at=3&door_s=5           the safety door is open for 5 s
sim://?hold_at=3                    somebody presses the hold button
sim://?mute_at=3                    nothing comes from the machine any more
sim://?stray_at=3                   another program's line is acknowledged
"""

import math
import random
from dataclasses import dataclass

from relieffab.grbl.simulator.machine import SimulatedGrbl


@dataclass(frozen=True)
class Faults:
    """What goes wrong.

    Parameters
    ----------
    flip, drop : float
        Chance of a byte to have one bit turned over, or to be lost.
    noise_at : float
        Seconds after the port was opened from which bytes are spoilt.
    seed : int
        Of both.
    unplug_at, reboot_at, limit_at, door_at, hold_at, mute_at, stray_at : float
        Seconds after the port was opened; inf for never.
    door_s : float
        Seconds for which the door is open.
    """

    flip: float = 0.0
    drop: float = 0.0
    noise_at: float = 0.0
    seed: int = 0
    unplug_at: float = math.inf
    reboot_at: float = math.inf
    limit_at: float = math.inf
    door_at: float = math.inf
    hold_at: float = math.inf
    mute_at: float = math.inf
    stray_at: float = math.inf
    door_s: float = 5.0

    def arrange(self, machine: SimulatedGrbl) -> None:
        """Let them happen."""
        for time, happen in (
            (self.reboot_at, machine.reboot),
            (self.limit_at, machine.hit_limit),
            (self.door_at, lambda: machine.open_door(self.door_s)),
            (self.hold_at, machine.suspension.hold),
            (self.stray_at, lambda: machine.say("ok")),
        ):
            if time < math.inf:
                machine.at(time, happen)


class Noise:
    """A line that alters and loses bytes.

    Parameters
    ----------
    faults : Faults

    Attributes
    ----------
    hits : int
        Bytes spoilt so far.
    """

    def __init__(self, faults: Faults) -> None:
        self._random = random.Random(faults.seed)
        self._flip, self._drop = faults.flip, faults.drop
        self._begin = faults.noise_at if faults.flip or faults.drop else math.inf
        self.hits = 0

    def spoil(self, data: bytes, now: float) -> bytes:
        """Let bytes pass."""
        if now < self._begin:
            return data
        out = bytearray()
        for byte in data:
            chance = self._random.random()
            if chance < self._drop:
                self.hits += 1
            elif chance < self._drop + self._flip:
                self.hits += 1
                out.append(byte ^ 1 << self._random.randrange(8))
            else:
                out.append(byte)
        return bytes(out)
