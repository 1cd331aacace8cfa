"""Workers of a Dask cluster, on as many machines as it has."""

import logging
import sys
import time
from collections.abc import Callable, Collection, Mapping
from concurrent.futures import CancelledError, Future
from types import TracebackType
from typing import Any

from relieffab.catalogue.task import Result, Task, Work
from relieffab.catalogue.work import carry_out
from relieffab.errors import InputError

PATIENCE = 20  # seconds for a scheduler to answer, and for the first worker to come


class Cluster:
    """The workers of a Dask scheduler, one job each at a time.

    What becomes of a job whose worker dies is the scheduler's business: it gives it to
    another, as often as its `distributed.scheduler.allowed-failures` says.

    Parameters
    ----------
    address : str
        Of the scheduler, such as tcp://host:8786.
    work : callable
        What they do with a task.
    tell : callable
        Given a sentence when there is nobody left to do the work, and when there is again.

    Raises
    ------
    InputError
        If Dask is not installed, no scheduler answers, or it has no workers.
    """

    tries = 1

    def __init__(
        self, address: str, work: Work = carry_out, tell: Callable[[str], None] = lambda _: None
    ) -> None:
        try:
            from distributed import Client, KilledWorker
        except ImportError:
            raise InputError(
                "many machines take Dask distributed, which is not installed",
                where="--scheduler",
                hint="pip install 'relieffab[cluster]', here and on every machine",
            ) from None
        # What goes wrong is told by `settle`, in a sentence.
        logging.getLogger("distributed").setLevel(logging.CRITICAL)
        self._address, self._work, self._killed = address, work, KilledWorker
        try:
            self._client: Any = Client(address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError) as fault:
            raise InputError(
                "no Dask scheduler answers",
                expected="such as tcp://host:8786",
                found=str(fault),
                where=address,
                hint="`dask scheduler` starts one, `dask worker ADDRESS` its workers",
            ) from fault
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError as fault:
            self._client.close()
            raise InputError(
                "the cluster has no workers",
                where=address,
                hint=f"dask worker {address}, on each machine",
            ) from fault
        limits = [worker["memory_limit"] for worker in self._workers().values()]
        self.room = max(limits) if all(limits) else sys.maxsize
        self._lack = _Lack(tell, address)

    def _workers(self) -> dict[str, Any]:
        return self._client.scheduler_info(n_workers=-1)["workers"]  # type: ignore[no-any-return]

    def __enter__(self) -> "Cluster":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._client.close()

    def free(self, running: Collection[Task]) -> int:
        """Tell how much memory a task may take where there are more workers than tasks."""
        workers = len(self._workers())
        self._lack.look(workers)
        return self.room if len(running) < max(1, workers) else -1

    def submit(self, task: Task) -> "Future[Result]":
        """Hand a task to the scheduler."""
        future: Future[Result] = Future()
        key = f"{task.name}-{task.token}"
        asked = self._client.submit(_on_worker, self._work, task, key=key, pure=False)
        asked.add_done_callback(lambda done: _pass_on(done, future))
        return future

    def trim(self, running: Mapping["Future[Result]", Task]) -> None:
        """Leave it to Dask, which ends workers above their own memory limit."""

    def settle(self, future: "Future[Result]") -> str:
        """Say how often workers died of a job, if they did."""
        if future.cancelled():
            raise InputError(
                "the scheduler is lost, or has dropped a job",
                where=self._address,
                hint="what is finished stays; the same command goes on from there",
            )
        error = future.exception()
        return str(error) if isinstance(error, self._killed) else ""


class _Lack:
    """Since when a cluster has been without workers, and whether that has been told.

    Parameters
    ----------
    tell : callable
    address : str
        Of the scheduler.
    """

    def __init__(self, tell: Callable[[str], None], address: str) -> None:
        self._tell, self._address = tell, address
        self._since: float | None = None
        self._told = False

    def look(self, workers: int) -> None:
        """Take note of how many workers there are now."""
        if workers:
            if self._told:
                self._tell("the cluster has workers again")
            self._since, self._told = None, False
            return
        if self._since is None:
            self._since = time.monotonic()
        if not self._told and time.monotonic() - self._since >= PATIENCE:
            self._told = True
            self._tell(
                f"the cluster has lost all its workers; waiting for others "
                f"(dask worker {self._address}; Ctrl-C stops, and what is finished stays)"
            )


def _pass_on(asked: Any, future: "Future[Result]") -> None:
    """Make a Dask future's end that of a plain one, for which anybody can wait."""
    if asked.cancelled():
        future.cancel()
        future.set_running_or_notify_cancel()
        return
    error = asked.exception()
    if isinstance(error, CancelledError):
        future.cancel()
        future.set_running_or_notify_cancel()
    elif error is not None:
        future.set_exception(error)
    else:
        future.set_result(asked.result())


def _on_worker(work: Work, task: Task) -> Result:
    """Do a task in a worker of a cluster, with as many threads as the worker has."""
    from distributed import get_worker

    from relieffab.compiled import limit_threads

    limit_threads(get_worker().state.nthreads)
    return work(task)
