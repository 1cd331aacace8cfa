"""Workers as processes of this machine, each with its share of the cores."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Collection, Iterator, Mapping
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing.process import BaseProcess
from types import TracebackType

import psutil

from relieffab.catalogue.task import Result, Task, Work
from relieffab.catalogue.work import carry_out
from relieffab.units import memory_text

THREADS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""What the libraries read, once, when they start."""


def cores() -> int:
    """Count the cores that this process may use."""
    process = psutil.Process()
    mine = len(process.cpu_affinity()) if hasattr(process, "cpu_affinity") else os.cpu_count()
    return mine or 1


def machine_memory() -> int:
    """Return the memory of this machine, bytes."""
    return int(psutil.virtual_memory().total)


class Processes:
    """Processes that carry out jobs, a new one in the place of any that dies.

    Parameters
    ----------
    workers : int
        Processes at most.
    memory : int
        What all jobs together may take, bytes.
    work : callable
        What they do with a task.
    """

    tries = 3

    def __init__(self, workers: int, memory: int, work: Work = carry_out) -> None:
        self.room = memory
        threads = max(1, cores() // workers)
        self._all = [_Worker(work, threads) for _ in range(workers)]
        self._idle = list(self._all)
        self._busy: dict[Future[Result], _Worker] = {}

    def __enter__(self) -> "Processes":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for worker in self._all:  # a stop may have fallen between idle and busy
            worker.end()

    def free(self, running: Collection[Task]) -> int:
        """Tell how much memory is left for one task more; negative without a worker for it."""
        return self.room - sum(task.memory for task in running) if self._idle else -1

    def submit(self, task: Task) -> "Future[Result]":
        """Have an idle worker carry out a task."""
        worker = self._idle.pop()
        future = worker.submit(task)
        self._busy[future] = worker
        return future

    def trim(self, running: Mapping["Future[Result]", Task]) -> None:
        """End the worker farthest above what was set aside for it, if all take more than they may.

        Workers without a job go first: they keep what their last one took.
        """
        taken = {future: self._busy[future].memory() for future in running}
        if sum(taken.values()) + sum(worker.memory() for worker in self._idle) <= self.room:
            return
        for worker in self._idle:
            worker.end()
        if sum(taken.values()) <= self.room:
            return
        worst = max(running, key=lambda future: taken[future] - running[future].memory)
        self._busy[worst].kill(
            f"the worker was ended: it took {memory_text(taken[worst])} where "
            f"{memory_text(running[worst].memory)} were set aside, "
            f"and all together more than {memory_text(self.room)}"
        )

    def settle(self, future: "Future[Result]") -> str:
        """Take the worker of a finished future back; say what it died of, if it did."""
        worker = self._busy.pop(future)
        self._idle.append(worker)
        return worker.death() if isinstance(future.exception(), BrokenProcessPool) else ""


class _Worker:
    """One process; the pool about it gives futures and notices its death."""

    def __init__(self, work: Work, threads: int) -> None:
        self._work, self._threads = work, threads
        self._pool: ProcessPoolExecutor | None = None
        self._process: BaseProcess | None = None
        self._guilt = ""

    def submit(self, task: Task) -> "Future[Result]":
        if self._pool is None:
            return self._begin(task)
        try:
            return self._pool.submit(self._work, task)
        except BrokenProcessPool:  # died while it had nothing to do
            self.end()
            return self._begin(task)

    def _begin(self, task: Task) -> "Future[Result]":
        context = multiprocessing.get_context("spawn")
        self._pool = ProcessPoolExecutor(1, mp_context=context, initializer=_live_and_die)
        before = set(multiprocessing.active_children())
        with _inherited(self._threads):
            future = self._pool.submit(self._work, task)
        self._process = next(iter(set(multiprocessing.active_children()) - before), None)
        return future

    def memory(self) -> int:
        """Measure what is resident of the process and of those it has begun, bytes."""
        if self._process is None or self._process.pid is None:
            return 0
        try:
            parent = psutil.Process(self._process.pid)
            family = [parent, *parent.children(recursive=True)]
        except psutil.NoSuchProcess:
            return 0
        return sum(_resident(process) for process in family)

    def kill(self, guilt: str) -> None:
        """End the process in the middle of its job, for a reason that `death` will give."""
        self._guilt = guilt
        if self._process is not None:
            self._process.kill()

    def death(self) -> str:
        process, guilt = self._process, self._guilt
        self.end()
        if guilt:
            return guilt
        code = process.exitcode if process else None
        if code is None or code >= 0:
            return f"the worker ended before the job did (exit status {code})"
        perhaps = ", perhaps for want of memory" if -code == signal.SIGKILL else ""
        return f"the worker was killed ({signal.Signals(-code).name}){perhaps}"

    def end(self) -> None:
        """End the process, whatever it does: what it has not finished leaves no trace."""
        if self._pool is not None:
            if self._process is not None:
                self._process.kill()
            self._pool.shutdown(cancel_futures=True)
        self._pool = self._process = None
        self._guilt = ""


def _resident(process: psutil.Process) -> int:
    try:
        return int(process.memory_info().rss)
    except psutil.NoSuchProcess:
        return 0


@contextmanager
def _inherited(threads: int) -> Iterator[None]:
    """Let a process that starts now have its share of cores, and not hear Ctrl-C."""
    before = {name: os.environ.get(name) for name in THREADS}
    held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGHUP})
    os.environ.update(dict.fromkeys(THREADS, str(threads)))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


def _live_and_die() -> None:
    """Have a worker end with the process that began it, however that ends."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent,), daemon=True).start()


def _follow(parent: BaseProcess) -> None:
    parent.join()
    os._exit(1)
