"""Workers as processes of this machine, each with its share of the cores."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Collection, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing.process import BaseProcess
from types import TracebackType

from relieffab.catalogue.task import Result, Task, Work
from relieffab.catalogue.work import carry_out

THREADS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""What the libraries read, once, when they start."""


def cores() -> int:
    """Count the cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def machine_memory() -> int:
    """Return the memory of this machine, bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


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
        self._idle = [_Worker(work, threads) for _ in range(workers)]
        self._busy: dict[Future[Result], _Worker] = {}

    def __enter__(self) -> "Processes":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for worker in (*self._busy.values(), *self._idle):
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

    def death(self) -> str:
        process = self._process
        self.end()
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
