"""One job on one machine as a pure state machine: bytes and the time in, bytes out.

No port is opened and no clock is read here, so that every order of events can be tried.

    Greeting --> ready --> Streaming: set up, program, spindle off --> done
        |                      |
        +----------------------+--> SafeStop --> failed
"""

import math
from dataclasses import replace

from relieffab.grbl.codes import STATES
from relieffab.grbl.controller import Controller
from relieffab.grbl.course import Course
from relieffab.grbl.feed import Feed
from relieffab.grbl.greeting import Greeting
from relieffab.grbl.job import Job, Plan, plan
from relieffab.grbl.messages import LineSplitter, Message, Point, Status, parse
from relieffab.grbl.pace import Pace
from relieffab.grbl.program import Line, Program, commands
from relieffab.grbl.realtime import NORMAL
from relieffab.grbl.record import RUNNING, Record
from relieffab.grbl.resume import Entry, approach
from relieffab.grbl.stage import Failure, Fault, Patience
from relieffab.grbl.stop import SafeStop
from relieffab.grbl.streaming import Streaming
from relieffab.grbl.view import View
from relieffab.grbl.way import Place

_CLOSING = ("M5", "M9")


class Session:
    """Send one program and see it through, or stop the machine safely.

    Parameters
    ----------
    job : Job
    patience : Patience
    now : float
        Seconds on any clock that only goes forward; the port was opened at this time.

    Attributes
    ----------
    over : bool
        Nothing is left to do; look at `failure`.
    plan : Plan or None
        What is about to happen, once the machine was asked; nothing moves before `go`.
    failure : Failure or None
        Why the job did not end well.
    outcome : str
        What became of the machine after a failure.
    errors : list of str
        What check mode refused.
    controller : Controller or None
    started, ended : float or None
        When the first line went out and when the last one was done.
    """

    def __init__(self, job: Job, *, patience: Patience | None = None, now: float) -> None:
        self.over = False
        self.plan: Plan | None = None
        self.failure: Failure | None = None
        self.outcome = ""
        self.errors: list[str] = []
        self.controller: Controller | None = None
        self.started: float | None = None
        self.ended: float | None = None
        self.position_kept = True
        self._job = job
        self._patience = patience or Patience()
        self._splitter = LineSplitter()
        self._course: Course | None = None
        self._pace: Pace | None = None
        self._main: Streaming | None = None
        self._feed: Feed | None = None
        self._queue: list[Program | Entry] = []
        self._overrides = (100, 100, 100)
        self._status: Status | None = None
        self._stage: Greeting | Streaming | SafeStop | None = Greeting(
            self._patience, now, locked=job.home or job.unlock
        )

    # -- what the driver calls ---------------------------------------------------------------

    def advance(self, received: bytes, now: float) -> bytes:
        """Take what came from the machine, in pieces of any size; give what is to be sent.

        To be called whenever something came, and at least every `Patience.poll` seconds.
        """
        for line in self._splitter.feed(received):
            self._take(parse(line), now)
        out = b""
        while not self.over and self._stage is not None:
            stage = self._stage
            out += stage.give(now)
            if stage.over:
                self._turn(now)
            if self._stage is stage:
                break
        return out

    @property
    def ready(self) -> bool:
        """True while the session waits for `go`."""
        return self._stage is None and not self.over

    def go(self, now: float) -> None:
        """Begin."""
        if self.plan is None or not self.ready:
            raise RuntimeError("the session is not ready")
        self.started = now
        self._queue = [*self.plan.setup]
        if self.plan.entry is not None:
            self._queue.append(self.plan.entry)
        self._queue.append(self._job.program)
        quiet = self._job.program.quiet and self.controller is not None and self.controller.quiet
        if not self._job.check and not quiet:
            self._queue.append(commands(*_CLOSING))
        self._pace = Pace(self.plan.table, self.plan.first)
        # followed up to its first line before the spindle turns: that may take seconds
        self._feed = Feed(self._job.program, self._nowhere, self.plan.first)
        self._begin(now)
        self.command(NORMAL)

    def command(self, data: bytes) -> None:
        """Pass real-time bytes on while lines are sent."""
        if isinstance(self._stage, Streaming):
            self._stage.command(data)

    def cancel(self, now: float) -> None:
        """Stop the machine safely; go on calling `advance` until `over`.

        Before the first line went out there is nothing to stop, and what the machine may do
        for somebody else is left alone.
        """
        self.abort(Failure(Fault.CANCELLED, "the job was cancelled"), now)

    def abort(self, failure: Failure, now: float) -> None:
        """Stop the machine safely for a reason of the caller's."""
        if self.over or self.failure is not None:
            return
        if self.started is None:
            self.failure, self.over = failure, True
        else:
            self._stop(failure, now)

    def reconnected(self, failure: Failure, now: float) -> None:
        """Stop the machine safely behind a port that went away and came back."""
        self._splitter = LineSplitter()
        self.over = False
        self._stop(self.failure or failure, now)
        self.failure = failure

    # -- what can be seen --------------------------------------------------------------------

    @property
    def acknowledged(self) -> int:
        """Lines of the program acknowledged so far."""
        return self._main.acknowledged if self._main else 0

    @property
    def cut_mm(self) -> float:
        """Length certainly cut, mm."""
        return self._course.cut_mm if self._course else 0.0

    @property
    def reached(self) -> Line | None:
        """The line at which the machine was last seen."""
        return self._course.reached if self._course else None

    @property
    def status(self) -> Status | None:
        """The latest status report."""
        return self._status

    @property
    def position(self) -> Point | None:
        """Where the machine was last seen, machine coordinates, mm."""
        if self._course is None or self._status is None:
            return None
        return self._course.machine_position(self._status)

    @property
    def held(self) -> bool:
        """True while the machine waits for a person."""
        return isinstance(self._stage, Streaming) and self._stage.held

    def view(self) -> View | None:
        """Give what a person sees; None before the first report of the program."""
        status, main, course, pace = self._status, self._main, self._course, self._pace
        if status is None or main is None or course is None or pace is None:
            return None
        reached = course.reached
        return View(
            state=status.state if status.substate is None else f"{status.state}:{status.substate}",
            meaning=STATES.get((status.state, status.substate), ""),
            cut_mm=course.cut_mm,
            total_mm=max(self._job.program.cut_mm, course.cut_mm),
            left_s=pace.left(reached.index if reached else 0),
            position=course.work_position(status),
            feed=status.feed or 0.0,
            speed=status.speed or 0.0,
            overrides=self._overrides,
            fill=main.window.bytes / main.window.capacity,
            line=reached.number if reached else 0,
        )

    def record(self) -> Record | None:
        """Give what is to be kept of the job; None before anything was sent, or at its end."""
        if self.started is None or self.controller is None or self.plan is None:
            return None
        if self._job.check or (self.over and self.failure is None):
            return None
        reached = self.reached
        return Record(
            program=self._job.program.digest,
            line=reached.number if reached else self.plan.number,
            position=self.position,
            work_zero=self.controller.work_zero,
            position_kept=self.over and self.position_kept,
            reason=self.failure.message if self.failure else RUNNING,
        )

    # -- within ------------------------------------------------------------------------------

    def _take(self, message: Message, now: float) -> None:
        stage = self._stage
        if self.over or stage is None:
            return
        if isinstance(message, Status):
            message = self._see(message, now)
        stage.take(message, now)
        if stage.over:
            self._turn(now)

    def _see(self, status: Status, now: float) -> Status:
        if self.controller is not None and self.controller.inches:
            status = status.in_mm()
        self._status = status
        self._overrides = status.overrides or self._overrides
        if self._pace is not None:
            self._pace.tick(now, moving=not status.held)
        if self._stopping_on_course and self._course is not None:
            self._course.report(status)
        return status

    @property
    def _stopping_on_course(self) -> bool:
        """True while the machine slows down on the way that was sent."""
        astray = self.failure is not None and self.failure.fault is Fault.OFF_COURSE
        return isinstance(self._stage, SafeStop) and not self._stage.resetting and not astray

    def _turn(self, now: float) -> None:
        """Go from a stage that is over to the next."""
        stage = self._stage
        if isinstance(stage, SafeStop):
            self.outcome, self.position_kept, self.over = stage.outcome, stage.position_kept, True
        elif isinstance(stage, Greeting):
            self._greeted(stage)
        elif isinstance(stage, Streaming) and stage.failure is not None:
            self._stop(stage.failure, now)
        elif isinstance(stage, Streaming):
            self.errors += stage.errors
            self._begin(now)

    def _greeted(self, greeting: Greeting) -> None:
        self.controller, self._stage = greeting.controller, None
        if greeting.failure is not None or greeting.controller is None or greeting.status is None:
            self.failure, self.over = greeting.failure, True
            return
        status = greeting.status.in_mm() if greeting.controller.inches else greeting.status
        found = plan(self._job, greeting.controller, status)
        if isinstance(found, Failure):
            self.failure, self.over = found, True
        else:
            self.plan = found

    def _begin(self, now: float) -> None:
        """Turn to the next part, or to the end."""
        if not self._queue:
            self.ended = now
            if self._job.check:
                self._stage = SafeStop(None, self._patience, now)
            else:
                self.over = True
            return
        part = self._queue.pop(0)
        controller = self.controller
        if controller is None or self._status is None:
            raise RuntimeError("the machine was not asked")
        course = Course(controller.blocks, controller.work_zero, controller.resolution)
        course.known = not controller.cleared_by(self._job.program.codes)
        position = course.work_position(self._status)
        if isinstance(part, Entry):
            height = math.inf if position is None else position[2]
            part = commands(*approach(part, height))
        main = part is self._job.program
        start = position or self._nowhere
        feed = self._feed if main and self._feed else Feed(part, start)
        feed.start_at(start)
        self._stage = Streaming(
            feed, course, controller.buffer, self._patience, now,
            attended=self._job.attended, checking=self._job.check and main,
        )  # fmt: skip
        if main:
            course.begin(feed.cut_mm)
            self._main, self._course = self._stage, course

    @property
    def _nowhere(self) -> Place:
        return (None,) * (self.controller.axes if self.controller else 3)

    def _stop(self, failure: Failure, now: float) -> None:
        if not failure.where and self.reached is not None:
            failure = replace(failure, where=self.reached.where)
        self.failure, self.ended = failure, now
        self._stage = SafeStop(failure, self._patience, now)
