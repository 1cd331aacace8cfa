"""Tasks to results, by whatever carries them out; a worker that dies takes no job with it."""

import traceback
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import replace
from typing import Protocol

from relieffab.catalogue.task import Fault, Result, Task
from relieffab.units import memory_text

TICK = 0.5  # seconds between two looks at whether the person wants to stop


class Engine(Protocol):
    """Workers: processes of this machine, or a cluster's.

    Attributes
    ----------
    room : int
        The most memory one job may take, bytes.
    tries : int
        How often a job is begun whose workers die.
    """

    room: int
    tries: int

    def free(self, running: Collection[Task]) -> int:
        """Tell how much memory a task may take that begins beside those that run, bytes.

        Negative where no worker is free.
        """

    def submit(self, task: Task) -> "Future[Result]":
        """Have a task carried out."""

    def trim(self, running: Mapping["Future[Result]", Task]) -> None:
        """End a worker that takes more memory than was set aside for it, if it must be."""

    def settle(self, future: "Future[Result]") -> str:
        """Take the worker of a finished future back; say what it died of, if it did."""


Outcome = tuple[Task, Result, int]
"""A task, what came of it, and how often it was begun."""


def outcomes(
    tasks: Sequence[Task], engine: Engine, heed: Callable[[], None] = lambda: None
) -> Iterator[Outcome]:
    """Have tasks carried out; give each as it is done, in whatever order.

    A task whose worker dies is begun again when the others have begun, with twice the memory
    set aside for it: that is what workers mostly die of.

    Parameters
    ----------
    tasks : sequence of Task
    engine : Engine
    heed : callable
        Called every now and then; raise from it to stop.
    """
    waiting, begun = list(tasks), Counter[str]()
    running: dict[Future[Result], Task] = {}
    while waiting or running:
        for task in [task for task in waiting if task.memory > engine.room]:
            waiting.remove(task)
            yield task, _too_large(task, engine.room), begun[task.name]
        while (ready := _first(waiting, engine.free(running.values()))) is not None:
            waiting.remove(ready)
            begun[ready.name] += 1
            running[engine.submit(ready)] = ready
        heed()
        engine.trim(running)
        for future in wait(running, timeout=TICK, return_when=FIRST_COMPLETED).done:
            task = running.pop(future)
            death = engine.settle(future)
            if death and begun[task.name] < engine.tries:
                waiting.append(replace(task, memory=min(2 * task.memory, engine.room)))
            else:
                yield task, _died(death) if death else _result(future), begun[task.name]


def _first(waiting: Sequence[Task], free: int) -> Task | None:
    return next((task for task in waiting if task.memory <= free), None)


def _too_large(task: Task, room: int) -> Fault:
    return Fault(
        "the job would take more memory than it may\n"
        f"  expected: at most {memory_text(room)}\n"
        f"  found: about {memory_text(task.memory)}, by its stage, resolution and model\n"
        "  try: more --memory, a lower --resolution or an earlier --stage"
    )


def _died(death: str) -> Fault:
    return Fault(
        f"{death}\n"
        "  try: a lower --resolution, fewer --workers, more --memory; or relieffab make on it alone"
    )


def _result(future: "Future[Result]") -> Result:
    error = future.exception()
    if error is None:
        return future.result()
    return Fault(
        f"relieffab itself failed: {type(error).__name__}: {error}\n"
        "  try: report it, with the model and the trace in batch.json",
        "".join(traceback.format_exception(error)),
    )
