"""Random faults, one schedule after the other, on the simulated machine.

    python tests/benchmarks/faults.py [COUNT] [FIRST SEED]

Each schedule is one job under noise on the line (bytes altered and lost, both ways) or a cable
pulled, a restart, a limit switch, an open door, a hold, silence, a second sender, or several of
them.  Whatever comes, the job has to end within bounded time, with the axes at rest and the
spindle off.  Without noise, what was cut has to be the program, or its beginning: no line twice,
none left out; and the record must not lie behind what was cut.  Where the machine kept its
position the job is taken up again and has to be cut to its end.

Under noise a digit may be altered on its way to the machine so that the way stays on the
programmed one between two reports; nothing that Grbl says gives that away.  Such jobs are
counted apart.  tests/grbl/test_faults.py runs the first hundreds of them.
"""

import math
import random
import sys
from collections import Counter
from dataclasses import dataclass

from relieffab.errors import MachineError
from relieffab.grbl.job import Job, Resume
from relieffab.grbl.port import open_port
from relieffab.grbl.program import prepare
from relieffab.grbl.record import Record
from relieffab.grbl.sender import Company, send

EVENTS = ("unplug_at", "reboot_at", "limit_at", "door_at", "hold_at", "mute_at", "stray_at")
LONGEST = 400.0
"""Simulated seconds in which every job must have ended."""
HEAD = 4
"""Lines of the program before the first that cuts."""
NEAR = 0.002


@dataclass
class Outcome:
    """One schedule: what was asked, what came of it."""

    url: str
    noisy: bool
    error: MachineError | None
    path: list
    points: list
    record: Record | None
    seconds: float
    spindle: float
    moving: bool
    resumed: bool = False
    unnoticed: bool = False

    @property
    def kind(self) -> str:
        """The first words of the error."""
        return "done" if self.error is None else str(self.error).splitlines()[0]


def try_schedule(seed: int) -> Outcome:
    """Run one schedule and hold it to the promises; AssertionError where one is broken."""
    rng = random.Random(seed)
    points = [
        (round(1 + (i % 5) * 0.4, 3), round(i // 5 * 0.3, 3), -0.5)
        for i in range(rng.randint(8, 60))
    ]
    text = "G21G90\nM3S1000\nG0X0Y0Z5\nF900\n" + "".join(f"G1X{x}Y{y}Z{z}\n" for x, y, z in points)
    url, noisy = schedule(rng, seed)
    kept: list = []
    with open_port(url) as port:
        program = prepare(text + "G0Z5\nM5\nM30\n")
        try:
            send(Job(program), port, Company(keep=kept.append))
            error = None
        except MachineError as caught:
            error = caught
        seconds, machine = port.now(), port.device.machine
        machine.run(machine.now + 20.0)
        outcome = Outcome(
            url, noisy, error, list(machine.path), points, kept[-1] if kept else None,
            seconds, machine.spindle, machine.planner.running,
        )  # fmt: skip
        judge(outcome)
        if outcome.record and outcome.record.position_kept and not noisy and error is not None:
            resume(outcome, port, program)
    return outcome


def schedule(rng: random.Random, seed: int) -> tuple[str, bool]:
    """Choose what goes wrong."""
    options = {"seed": seed, "$10": rng.choice([1, 3]), "latency": rng.choice([0.001, 0.016])}
    options["rx_buffer"] = rng.choice([100, 128, 256, 1024])
    noisy = rng.random() < 0.5
    if noisy:
        options["flip"] = f"{10 ** rng.uniform(-4.5, -2):.2e}"
        options["drop"] = f"{10 ** rng.uniform(-4.5, -2):.2e}"
        options["noise_at"] = rng.choice([0, 1, 1, 1])
    for event in rng.sample(EVENTS, rng.choice([0, 1]) if noisy else rng.choice([1, 1, 2])):
        options[event] = f"{rng.uniform(0.1, 9):.3f}"
    url = "sim://?speed=max&boot=0.1&" + "&".join(f"{k}={v}" for k, v in options.items())
    return url, noisy


def judge(outcome: Outcome) -> None:
    """Hold an outcome to the promises."""
    where = f"{outcome.url}: {outcome.kind}"
    assert outcome.seconds < LONGEST, f"no end: {where}"
    assert not outcome.moving, f"still moving: {where}"
    assert not outcome.spindle, f"spindle on: {where}"
    done = cut(outcome)
    outcome.unnoticed = outcome.error is None and done < len(outcome.points)
    if outcome.noisy:
        return
    assert not outcome.unnoticed, f"a line is missing: {where}"
    if outcome.error is not None and done < 0:
        raise AssertionError(f"cut otherwise than programmed: {where}")
    if outcome.record is not None:
        assert outcome.record.line <= HEAD + done + 1, f"the record skips lines: {where}"


def cut(outcome: Outcome) -> int:
    """How many points of the program were reached, in order; -1 where others were as well."""
    at, points = 0, outcome.points
    for point in outcome.path:
        if at == len(points):
            break
        if math.dist(point, points[at]) < NEAR:
            at += 1
        elif at and not between(points[at - 1], points[at], point):
            return -1
    return at


def between(a: tuple, b: tuple, point: tuple) -> bool:
    """Whether a point lies on the way from a to b, as where a machine was stopped."""
    return math.dist(a, point) + math.dist(point, b) < math.dist(a, b) + 3 * NEAR


def resume(outcome: Outcome, port: object, program: object) -> None:
    """Take the job up again on the same machine."""
    machine = port.device.machine
    machine.wire.sent.clear()
    if machine.state != "Idle" or outcome.record.line < HEAD:  # nothing to go on from yet
        return
    before = len(machine.path)
    outcome.resumed = True
    try:
        send(Job(program, resume=Resume(outcome.record)), port)
    except MachineError as error:  # the schedule's second fault
        outcome.resumed = "at=" in outcome.url and outcome.url.count("_at=") > 1
        assert outcome.resumed, f"not taken up again: {outcome.url}: {error}"
        return
    first = max(outcome.record.line - HEAD - 1, 0)
    tail = machine.path[before:]
    rest = outcome.points[first:]
    found = [point for point in tail if point[2] < 0][-len(rest) :] if rest else []
    assert all(
        abs(a - b) < NEAR
        for p, q in zip(found, rest, strict=True)
        for a, b in zip(p, q, strict=True)
    ), f"the rest was cut otherwise: {outcome.url}"


def main() -> None:
    """Print what came of all of them."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    kinds: Counter = Counter()
    resumed = unnoticed = noisy = longest = 0
    for seed in range(first, first + count):
        outcome = try_schedule(seed)
        kinds[outcome.kind.partition(" sim://")[0]] += 1
        resumed += outcome.resumed
        noisy += outcome.noisy
        unnoticed += outcome.unnoticed
        longest = max(longest, outcome.seconds)
    for kind, number in kinds.most_common():
        print(f"{number:7,}  {kind}")
    print(f"{count:,} fault schedules, {noisy:,} with noise on the line; none hung (longest")
    print(
        f"{longest:.0f} simulated s), no line lost or doubled without noise, spindle off after all"
    )
    print(f"{resumed:,} jobs taken up again; {unnoticed} with an altered digit that nothing shows")


if __name__ == "__main__":
    main()
