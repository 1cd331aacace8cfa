"""One job on one machine as a pure state machine: bytes and the time in, bytes out.

No port is opened and no clock is read here, so that every order of events can be tried.

    Greeting --> Streaming --> done
        |            |
        +------------+--> SafeStop --> failed
"""

from dataclasses import replace

from relieffab.grbl.controller import Controller, misfits
from relieffab.grbl.greeting import Greeting
from relieffab.grbl.messages import LineSplitter, Message, Status, parse
from relieffab.grbl.program import Program
from relieffab.grbl.stage import Failure, Fault, Patience
from relieffab.grbl.stop import SafeStop
from relieffab.grbl.streaming import Streaming


class Session:
    """Send one program and see it through, or stop the machine safely.

    Parameters
    ----------
    program : Program
    patience : Patience
    now : float
        Seconds on any clock that only goes forward; the port was opened at this time.

    Attributes
    ----------
    over : bool
        Nothing is left to do; look at `failure`.
    lost : bool
        Set by whoever finds that nothing reaches the machine any more.
    failure : Failure or None
        Why the job did not end well.
    outcome : str
        What became of the machine after a failure.
    controller : Controller or None
    notes : list of str
        What the person should know though it stops nothing.
    """

    def __init__(self, program: Program, *, patience: Patience | None = None, now: float) -> None:
        self.over = False
        self.lost = False
        self.failure: Failure | None = None
        self.outcome = ""
        self.controller: Controller | None = None
        self.notes: list[str] = []
        self.started: float | None = None
        self.ended: float | None = None
        self._program = program
        self._patience = patience or Patience()
        self._splitter = LineSplitter()
        self._streaming: Streaming | None = None
        self._stage: Greeting | Streaming | SafeStop = Greeting(self._patience, now)

    def advance(self, received: bytes, now: float) -> bytes:
        """Take what came from the machine, in pieces of any size; give what is to be sent.

        To be called whenever something came, and at least every `Patience.poll` seconds.
        """
        for line in self._splitter.feed(received):
            self._take(parse(line), now)
        out = b""
        while not self.over:
            stage = self._stage
            out += stage.give(now)
            if stage.over:
                self._turn(now)
            if self._stage is stage:
                break
        return out

    def cancel(self, now: float) -> None:
        """Stop the machine safely; go on calling `advance` until `over`.

        Before the first line went out there is nothing to stop, and what the machine may do
        for somebody else is left alone.
        """
        if self.over or self.failure is not None:
            return
        failure = Failure(Fault.CANCELLED, "the job was cancelled")
        if self.started is None:
            self.failure, self.over = failure, True
        else:
            reached = min(self.acknowledged, len(self._program) - 1)
            self._stop(replace(failure, line=reached), now)

    def resume(self) -> None:
        """End a pause."""
        if isinstance(self._stage, Streaming):
            self._stage.resume()

    @property
    def held(self) -> bool:
        """True while the machine waits to be resumed."""
        return isinstance(self._stage, Streaming) and self._stage.held

    @property
    def acknowledged(self) -> int:
        """Lines of the program acknowledged so far."""
        return self._streaming.acknowledged if self._streaming else 0

    @property
    def sent(self) -> int:
        """Lines of the program sent so far."""
        return self._streaming.sent if self._streaming else 0

    @property
    def cut_mm(self) -> float:
        """Length certainly cut, mm."""
        return self._streaming.cut_mm if self._streaming else 0.0

    @property
    def status(self) -> Status | None:
        """The latest status report while streaming."""
        return self._streaming.status if self._streaming else None

    def _take(self, message: Message, now: float) -> None:
        if self.over:
            return
        self._stage.take(message, now)
        if self._stage.over:
            self._turn(now)

    def _turn(self, now: float) -> None:
        """Go from a stage that is over to the next."""
        stage = self._stage
        if isinstance(stage, SafeStop):
            self.outcome, self.over = stage.outcome, True
        elif isinstance(stage, Greeting):
            self._greeted(stage, now)
        elif stage.failure is not None:
            self._stop(stage.failure, now)
        else:
            self.over, self.ended = True, now

    def _greeted(self, greeting: Greeting, now: float) -> None:
        self.controller = greeting.controller
        if greeting.failure is not None or greeting.controller is None:
            self.failure, self.over = greeting.failure, True
            return
        controller = greeting.controller
        found = misfits(self._program, controller)
        if found and controller.soft_limits and self._program.bounds_certain:
            self.failure = Failure(
                Fault.MISFIT,
                "the program does not fit the machine, which would stop at its soft limits",
                found="; ".join(found),
                hint="move work zero or turn the job",
            )
            self.over = True
            return
        self.notes += found
        self.started = now
        self._streaming = self._stage = Streaming(
            self._program, controller.buffer, controller.blocks, self._patience, now
        )

    def _stop(self, failure: Failure, now: float) -> None:
        self.failure, self.ended = failure, now
        self._stage = SafeStop(failure.fault, self._patience, now)
