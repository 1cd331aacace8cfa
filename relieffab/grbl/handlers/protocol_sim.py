"""`sim://`: the simulated Grbl behind the face of a serial port.

    sim://?speed=max                 as fast as the host can: time is what the machine needs
    sim://?speed=1                   in real time; 20 is twenty times as fast
    sim://?boot=0.1&$110=5000        seconds to the banner; settings
    sim://?axes=4&$113=3600          a grblHAL with a rotary axis A
    sim://?unplug_at=3               a fault (see simulator/faults.py)

Under `speed=max` the clock goes on only while the caller waits in `read`.  Nothing here
needs pyserial; its `serial_for_url` calls `Serial(None, **settings)`, sets `port` and opens.
"""

import io
import math
import time
from collections.abc import Callable
from dataclasses import fields
from typing import ClassVar
from urllib.parse import parse_qsl, urlsplit

from relieffab.errors import InputError, suggest
from relieffab.grbl.simulator import SimulatedGrbl
from relieffab.grbl.simulator.faults import Faults, Noise

LATENCY = 0.004
"""Seconds a USB adapter collects what the controller says before it hands it over."""
SHORTEST_SLEEP, LONGEST_SLEEP = 0.0005, 0.05
"""Seconds on the host's clock between two looks at the machine."""

_NUMBERS: dict[str, Callable[[str], float]] = {
    "axes": int,
    "rx_buffer": int,
    "planner_blocks": int,
    **dict.fromkeys(("line_rate", "baud", "boot", "latency", "plate"), float),
}
_FAULTS: dict[str, Callable[[str], float]] = {
    field.name: int if field.name == "seed" else float for field in fields(Faults)
}
_OPTIONS = (*_NUMBERS, *_FAULTS, "blank", "speed", "$110")
OUT_OF_SIGHT = 30.0
"""Seconds for which a machine goes on by itself until its cable is back."""


class Serial(io.RawIOBase):
    """As much of pyserial's interface as a Grbl sender uses.

    Attributes
    ----------
    machine : SimulatedGrbl
        What is simulated; there once the port is open.
    """

    _unplugged: ClassVar[dict[str, SimulatedGrbl]] = {}

    def __init__(
        self, port: str | None = None, baudrate: int = 115200, *, timeout: float | None = None,
        **ignored: object,
    ) -> None:  # fmt: skip
        super().__init__()
        self.port = port
        self.baudrate = baudrate
        self.timeout = timeout
        self.is_open = False
        self._options = ignored

    def open(self) -> None:
        """Switch the simulated controller on."""
        options = read_url(self.port or "sim://")
        self._speed = options.pop("speed")
        self._pace = 1.0 if self._speed == math.inf else self._speed
        self._latency = options.pop("latency")
        self._faults: Faults = options.pop("faults")
        self._out, self._in = Noise(self._faults), Noise(self._faults)
        self._pulled = self._faults.unplug_at
        again = self._unplugged.pop(self.port or "", None)
        if again is None:
            self.machine = SimulatedGrbl(**({"baud": float(self.baudrate)} | options))
            self._faults.arrange(self.machine)
        else:
            self.machine = again
            self._plug_in()
        self._opened = time.monotonic() - self.machine.now / self._pace
        self.is_open = True

    def _plug_in(self) -> None:
        """Open the port of a machine that went on by itself: that resets its board."""
        self._pulled = math.inf
        self.machine.run(self.machine.now + OUT_OF_SIGHT)
        self.machine.wire.sent.clear()
        self.machine.reboot()

    def _unplug(self) -> None:
        """Fail as a port does whose cable was pulled."""
        if self.machine.now >= self._pulled:
            self._unplugged[self.port or ""] = self.machine
            raise OSError("device reports readiness to read but returned no data (disconnected?)")

    def now(self) -> float:
        """Give the simulated seconds since the port was opened."""
        if self._speed == math.inf:
            return self.machine.now
        return (time.monotonic() - self._opened) * self._pace

    def readable(self) -> bool:
        """As a serial port."""
        return True

    def writable(self) -> bool:
        """As a serial port."""
        return True

    @property
    def in_waiting(self) -> int:
        """Bytes that can be read at once."""
        self._catch_up()
        now, count = self.machine.now, 0
        for at, data in self.machine.wire.sent:
            if at > now:
                break
            count += len(data)
        return count

    def read(self, size: int = 1) -> bytes:
        """Read up to `size` bytes, waiting for the first (not for all) up to the timeout."""
        machine, sent = self.machine, self.machine.wire.sent
        deadline = math.inf if self.timeout is None else self.now() + self.timeout * self._pace
        step = machine.step if self._speed == math.inf else self._live
        self._catch_up()
        while True:
            self._unplug()
            due = sent[0][0] + self._latency if sent else math.inf
            if due <= machine.now:
                return self._heard(self._collect(size))
            if machine.now >= deadline:
                return b""
            until = min(due, deadline)
            if until == math.inf and not machine.busy and self._speed == math.inf:
                raise TimeoutError("the simulated machine has nothing to do and will never answer")
            step(until)

    def write(self, data: bytes) -> int:  # type: ignore[override]
        """Send bytes."""
        self._catch_up()
        self._unplug()
        self.machine.write(self._out.spoil(bytes(data), self.machine.now))
        return len(data)

    def _heard(self, data: bytes) -> bytes:
        now = self.machine.now
        return b"" if now >= self._faults.mute_at else self._in.spoil(data, now)

    def reset_output_buffer(self) -> None:
        """Nothing is kept back."""

    def flush(self) -> None:
        """Nothing is kept back."""

    def reset_input_buffer(self) -> None:
        """Drop what has come in."""
        while self.in_waiting:
            self._collect(self.in_waiting)

    def close(self) -> None:
        """Unplug."""
        self.is_open = False
        super().close()

    def _catch_up(self) -> None:
        if self._speed != math.inf:
            self.machine.run(self.now())

    def _live(self, until: float) -> None:
        """Sleep until the next event, or `until`, as the host's clock has it."""
        event = min(until, self.machine.next_event())
        pause = (event - self.now()) / self._speed
        time.sleep(min(max(pause, SHORTEST_SLEEP), LONGEST_SLEEP))
        self._catch_up()

    def _collect(self, size: int) -> bytes:
        sent, now, out = self.machine.wire.sent, self.machine.now, b""
        while sent and sent[0][0] <= now and len(out) < size:
            at, data = sent.popleft()
            out += data
            if len(out) > size:
                sent.appendleft((at, out[size:]))
                out = out[:size]
        return out


def read_url(url: str) -> dict:
    """Read the options of a `sim://` URL.

    Returns
    -------
    dict
        `speed` (inf for max), `latency`, `faults`, and what `SimulatedGrbl` takes.
    """
    options: dict = {"speed": 1.0, "latency": LATENCY}
    faults: dict = {}
    settings: dict[int, float] = {}
    for key, value in parse_qsl(urlsplit(url).query, keep_blank_values=True):
        try:
            if key.startswith("$"):
                settings[int(key[1:])] = float(value)
            elif key == "speed":
                options[key] = math.inf if value == "max" else float(value)
            elif key == "blank":
                options[key] = value not in ("", "0", "false")
            elif key in _FAULTS:
                faults[key] = _FAULTS[key](value)
            elif key in _NUMBERS:
                options[key] = _NUMBERS[key](value)
            else:
                raise InputError(
                    "unknown option of the simulator",
                    found=repr(key),
                    where=url,
                    hint=suggest(key, _OPTIONS),
                )
        except ValueError:
            raise InputError(
                "this option of the simulator needs a number",
                found=f"{key}={value}",
                where=url,
            ) from None
    if options["speed"] <= 0:
        raise InputError("the speed must be more than 0, or max", where=url)
    if options.get("axes", 3) not in (3, 4):
        raise InputError("the simulator has three axes, or four with A", where=url)
    options["faults"] = Faults(**faults)
    if settings:
        options["settings"] = settings
    return options
