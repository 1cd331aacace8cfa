"""The simulated controller: a virtual clock, and what happens when.

Nothing happens by itself: `step` goes to the next event (a byte arrives, a line has been
parsed, a move ends) or to the given time, whichever comes first.  So simulated seconds cost
only what their events cost, and every run of the same bytes at the same times is the same.
"""

import heapq
import math
from array import array
from collections.abc import Callable

from relieffab.grbl.simulator import reports
from relieffab.grbl.simulator.interpreter import Interpreter, Move
from relieffab.grbl.simulator.planner import Planner, Point
from relieffab.grbl.simulator.probing import Prober
from relieffab.grbl.simulator.processor import Processor
from relieffab.grbl.simulator.realtime import Overrides, act
from relieffab.grbl.simulator.settings import Settings
from relieffab.grbl.simulator.suspend import Suspension
from relieffab.grbl.simulator.wire import Wire

_CRITICAL = (1, 2)
# Bytes of the receive buffer, moves looked ahead, lines a second: of 8 bits, and of 32.
_GRBL, _HAL = (128, 15, 400.0), (1024, 100, 2000.0)


class SimulatedGrbl:
    """A Grbl 1.1h with a machine behind it, or a grblHAL with a rotary axis A, too.

    Parameters
    ----------
    settings : dict, optional
        `$number` -> value over the defaults of simulator/settings.py.
    axes : int
        Three; four make it a grblHAL: its greeting, its answers, A in reports and settings.
    rx_buffer, planner_blocks : int, optional
        Bytes of the receive buffer, moves of the look-ahead.
    line_rate : float, optional
        Lines the processor reads a second when nothing else holds it up.
    baud : float
    boot : float
        Seconds from opening the port to the banner.
    blank : bool
        Start with a blank EEPROM, which prints a page of noise before the banner.
    plate : float
        Machine Z of a touch plate that the probe meets, mm; -inf where there is none.

    Attributes
    ----------
    now : float
        Simulated seconds since the port was opened.
    state : str
        Boot, Idle, Run, Hold, Jog, Door, Home, Alarm, Check, Sleep.
    spindle : float
        rpm; 0 is off.
    """

    def __init__(
        self,
        *,
        settings: dict[int, float] | None = None,
        axes: int = 3,
        rx_buffer: int | None = None,
        planner_blocks: int | None = None,
        line_rate: float | None = None,
        baud: float = 115200.0,
        boot: float = 1.6,
        blank: bool = False,
        plate: float = -math.inf,
    ) -> None:
        buffer, blocks, rate = _GRBL if axes == len("XYZ") else _HAL
        self.settings = Settings(settings, axes)
        self.interpreter = Interpreter(self.settings)
        self.planner = Planner(self.settings, planner_blocks or blocks)
        self.wire = Wire(baud, rx_buffer or buffer)
        self.overrides = Overrides()
        self.startup = ["", ""]
        self.now = 0.0
        self.state = "Boot"
        self.spindle = 0.0
        self._path = array("d")
        self._reports = reports.StatusReports()
        self._processor = Processor(self, 1.0 / (line_rate or rate))
        self._booted = boot
        self._boot_seconds = boot
        self._blank = blank
        self.suspension = Suspension(self)
        self.prober = Prober(self, plate)
        self._events: list[tuple[float, int, Callable[[], None]]] = []
        self.probed = reports.Probed((0.0,) * axes)
        self._dead = self._limited = False
        self.wire.deaf_until = boot

    @property
    def path(self) -> list[Point]:
        """Machine positions (mm) at the end of every move made, and at every stop."""
        values = iter(self._path)
        return list(zip(*[values] * self.settings.axes, strict=True))

    @property
    def lost(self) -> int:
        """Bytes that were sent and never read."""
        return self.wire.lost

    @property
    def busy(self) -> bool:
        """True while anything is on the wire, being read or being moved."""
        return self.next_event() < math.inf

    def write(self, data: bytes) -> None:
        """Put bytes on the wire, now."""
        self.wire.push(data, self.now)

    def say(self, text: str) -> None:
        """Print a line."""
        self.wire.say(text, self.now)

    def at(self, time: float, happen: Callable[[], None]) -> None:
        """Have something happen to the machine at a time."""
        heapq.heappush(self._events, (time, len(self._events), happen))

    def next_event(self) -> float:
        """When something happens next, as far as the bytes known now decide."""
        event = min(self.planner.end, self._booted, self.suspension.restored)
        if self._events:
            event = min(event, self._events[0][0])
        if self.wire.urgent:
            event = min(event, self.wire.urgent[0][0])
        if self._processor.ready > self.now:
            return min(event, self._processor.ready)
        if self._processor.wants_a_line and not self._dead:
            return min(event, self.wire.newline_at())
        return event

    def step(self, until: float) -> None:
        """Go on to the next event, or to `until` if that comes first."""
        event = self.next_event()
        if event > until:
            self.now = max(self.now, until)
            self._deliver()
            return
        self.now = max(self.now, event)
        self._deliver()
        while self._events and self._events[0][0] <= self.now:
            heapq.heappop(self._events)[2]()
        if self._booted <= self.now:
            self._boot()
        if self.suspension.restored <= self.now:
            self.suspension.go_on()
        if self.wire.urgent and self.wire.urgent[0][0] <= self.now:
            self.work()  # Grbl looks at real-time bytes between lines, never within one
            _, byte = self.wire.urgent.popleft()
            if self.state != "Boot":
                act(self, byte)
        if self.planner.end <= self.now:
            self._move_ended()
        self.work()

    def run(self, until: float) -> None:
        """Go on to `until`, through all events on the way."""
        while self.now < until:
            self.step(until)

    # -- what real-time bytes and $ commands ask for ------------------------------------

    def report(self) -> None:
        """Answer `?`; after a limit was hit, nothing is answered until a reset."""
        if self._dead:
            return
        position, speed = self.planner.motion(self.now)
        self.say(
            self._reports.line(
                self.suspension.name(),
                position,
                offset=self.interpreter.coordinates.work_offset,
                room=(self.planner.size - len(self.planner.blocks), self.wire.free),
                pace=(speed * 60.0, self.spindle),
                overrides=self.overrides.values,
                accessories=self._accessories(),
                mask=int(self.settings[10]),
                inches=bool(self.settings[13]),
            )
        )

    def open_door(self, seconds: float) -> None:
        """Open the safety door, and close it after so many seconds."""
        self.suspension.door_open = True
        self.suspension.hold("Door")
        self.at(self.now + seconds, self._close_door)

    def _close_door(self) -> None:
        self.suspension.door_open = False

    def toggle_coolant(self) -> None:
        """Switch the flood coolant."""
        if self.state in ("Idle", "Run", "Hold"):
            self.interpreter.coolant = 9 if self.interpreter.coolant == 8 else 8

    def hit_limit(self) -> None:
        """Run into a limit switch: stop at once, position lost."""
        self.alarm(1)

    def reboot(self) -> None:
        """Lose power for a moment, or be reset by the port: all but the EEPROM is forgotten."""
        self._restart_quietly()
        coordinates = self.interpreter.coordinates
        coordinates.position = coordinates.nowhere
        self.planner.set_position(tuple(coordinates.position))
        self.probed = reports.Probed(tuple(coordinates.position))
        self.state = "Boot"
        self._booted = self.now + self._boot_seconds
        self.wire.deaf_until = self._booted

    def reset(self) -> None:
        """Ctrl-X: stop at once; in motion that loses steps and locks the machine."""
        if self.state == "Sleep":
            self.state = "Alarm"
        moving = self.planner.running or self.state == "Home"
        if moving and self.state != "Alarm":
            self.alarm(6 if self.state == "Home" else 3)
        self.restart()

    def deafen(self, seconds: float) -> None:
        """Lose bytes while the EEPROM is written."""
        self.wire.deaf_until = self.now + seconds
        self.occupy(seconds)

    def occupy(self, seconds: float) -> None:
        """Keep the main program from its lines."""
        self._processor.ready = self.now + seconds

    # -- what the main program asks for ---------------------------------------------------

    def start(self) -> None:
        """Set off with the moves that wait."""
        if self.state == "Idle" and self.planner.blocks:
            self.state = "Run"
            self.planner.start(self.now)

    def outside(self, move: Move) -> bool:
        """Whether a soft limit forbids a move."""
        return bool(self.settings[20]) and not all(
            -travel <= value <= 0.0
            for travel, value in zip(self.settings.travel, move.target, strict=True)
            if travel
        )

    def limit_reached(self) -> None:
        """Brake, then lock up and be silent until reset."""
        if self.planner.running:
            self._limited = True
            self.suspension.hold()
        else:
            self.alarm(2)

    def homed(self) -> None:
        """Stand off the switches, position known."""
        pull = self.settings[27]
        place = (-pull, -pull, -pull, *self.planner.position[3:])  # A has no switch
        self.planner.set_position(place)
        self.interpreter.coordinates.position = list(place)
        self.state = "Idle"

    def offset_changed(self) -> None:
        """Have the next status report name the offset."""
        self._reports.offset_changed()

    # -- within ---------------------------------------------------------------------------

    def work(self) -> None:
        """Go on with what waits, where nothing holds it up."""
        if not self._dead and self.state not in ("Boot", "Hold", "Door"):
            self._processor.work()

    def _deliver(self) -> None:
        idle = self._processor.ready <= self.now and self._processor.wants_a_line
        self.wire.deliver(self.now, draining=idle and not self._dead)

    def _boot(self) -> None:
        self._booted = math.inf
        if self._blank:
            self.say("error:7")
            for line in self.settings.lines():
                self.say(line)
        self.state = "Alarm" if self.settings[22] else "Idle"
        self._greet()
        if self._blank:
            self.say(">:error:7")
            self.say(">:error:7")

    def _accessories(self) -> str:
        turning = {3: "S", 4: "C"}.get(self.interpreter.spindle, "") if self.spindle else ""
        return turning + ("F" if self.interpreter.coolant == 8 else "")

    def restart(self) -> None:
        """Start anew, with the position that is known."""
        self._restart_quietly()
        self.state = "Alarm" if self.state == "Alarm" else "Idle"
        self._greet()

    def _restart_quietly(self) -> None:
        self.suspension.restored = math.inf
        self.prober.clear()
        self._dead = self._limited = False
        position = self.planner.motion(self.now)[0]
        if self.planner.running or (self.planner.holding and self.planner.blocks):
            self._path.extend(position)
        self.planner.set_position(position)
        self.interpreter.reset()
        self.interpreter.coordinates.position = list(position)
        self.overrides = Overrides()
        self.planner.override(1.0, 1.0, self.now)
        self.spindle = 0.0
        self.wire.clear()
        self._processor.clear()

    def _greet(self) -> None:
        self.say("")
        self.say(reports.BANNER if self.settings.axes == len("XYZ") else reports.HAL_BANNER)
        if self.state == "Alarm":
            self.say(reports.LOCKED)
            return
        for block in self.startup:
            if block:
                self._processor.load(self.interpreter.run(block))
                self.say(f">{block}:ok")

    def _move_ended(self) -> None:
        reached = self.planner.finish(self.now)
        self._path.extend(self.planner.position if reached is None else reached)
        if self._limited and not self.planner.running:
            self.alarm(2)
        elif self.state == "Run" and not self.planner.running:
            self.state = "Idle"
        elif self.state == "Jog" and not self.planner.running:
            self.planner.set_position(self.planner.motion(self.now)[0])
            self.interpreter.coordinates.position = list(self.planner.position)
            self.state = "Idle"

    def alarm(self, code: int) -> None:
        """Lock up; after a limit the controller is silent until it is reset."""
        self.state = "Alarm"
        self.spindle = 0.0
        self.say(f"ALARM:{code}")
        if code in _CRITICAL:
            self.say("[MSG:Reset to continue]")
            position = self.planner.motion(self.now)[0]
            self.planner.set_position(position)
            self._dead = True
