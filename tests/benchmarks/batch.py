"""A batch of 200 small jobs by one worker, and by two of which one is killed midway.

    python tests/benchmarks/batch.py [JOBS] [RESOLUTION]

By processes and by a local Dask cluster, with jobs that only wait, a quarter of a second each, and
with reliefs.  The former tell what the batch itself costs, whatever else the machine has to do; of the
latter what came out is counted on the disk.  Where cores are taken, two workers cannot be twice as fast
as one: so the ratio of two processes that merely count is printed, too, and how many jobs were in the
making at once.
"""

import multiprocessing
import os
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

import numpy as np
import trimesh

from relieffab.catalogue import run
from relieffab.catalogue.cluster import Cluster
from relieffab.catalogue.entries import Entry, entries
from relieffab.catalogue.listing import wanted
from relieffab.catalogue.processes import Processes
from relieffab.subject import shapes

ROOM = 16 << 30
COUNTED = 30_000_000


def models(count: int, folder: Path) -> None:
    """Write bumpy stones, each another."""
    folder.mkdir()
    for k in range(count):

        def bumpy(unit: np.ndarray, k: int = k) -> np.ndarray:
            return 10 + np.sin(3 * unit[:, 0] + k) + np.cos((4 + k % 5) * unit[:, 1])

        vertices, faces = shapes.star(bumpy, 4000)
        trimesh.Trimesh(vertices, faces, process=False).export(folder / f"stone-{k:03}.ply")


def count_up(_: int) -> None:
    """Keep a core busy for a while."""
    for _ in range(COUNTED):
        pass


def ceiling() -> float:
    """How much faster two processes are than one here and now, at mere counting."""
    seconds = {}
    for workers in (1, 2):
        with multiprocessing.get_context("spawn").Pool(workers) as pool:
            pool.map(abs, range(4), chunksize=1)
            begin = time.perf_counter()
            pool.map(count_up, range(4), chunksize=1)
            seconds[workers] = time.perf_counter() - begin
    return seconds[1] / seconds[2]


class Watch:
    """Notes when each row is told, and kills a worker when half of them are."""

    def __init__(self, half: int, victim: Callable[[], int] | None) -> None:
        self.told: dict[str, list[float]] = {}
        self._half, self._victim = half, victim

    def __call__(self, row: dict) -> None:
        self.told.setdefault(row["name"], []).append(time.time())
        if self._victim and len(self.told) == self._half:
            os.kill(self._victim(), signal.SIGKILL)


def measure(
    title: str,
    jobs: list[Entry],
    folder: Path,
    engine: Callable[..., AbstractContextManager],
    victim: Callable[[], int] | None = None,
) -> float:
    """Run a batch, print what became of it, and return its seconds."""
    watch = Watch(len(jobs) // 2, victim)
    begin = time.perf_counter()
    found = run.batch(jobs, folder, "relief", engine, tell=watch)
    seconds = time.perf_counter() - begin
    reports = {path.parent.name: path.stat().st_mtime for path in folder.glob("*/report.json")}
    again = sum(reports[name] > times[0] for name, times in watch.told.items())
    twice = sum(len(times) > 1 for times in watch.told.values())
    tries = Counter(row["tries"] for row in found["jobs"])
    at_once = sum(row["seconds"] for row in found["jobs"]) / seconds
    left = [p.name for p in folder.rglob(".*")]
    print(
        f"{title:<28} {seconds:7.1f} s  {found['done']} done, {found['failed']} failed, "
        f"{len(reports)} results, {twice + again} twice, begun {dict(tries)}, "
        f"{at_once:.2f} at once, {len(left)} scraps",
        flush=True,
    )
    return seconds


def by_processes(jobs: list[Entry], home: Path) -> float:
    """Return how much faster two processes are than one, though one is killed."""

    def victim() -> int:
        return multiprocessing.active_children()[0].pid or 0

    def pair(_: object) -> Processes:
        return Processes(2, ROOM)

    two = measure("two processes, one killed", jobs, home / "p2", pair, victim)
    one = measure("one process", jobs, home / "p1", lambda _: Processes(1, ROOM))
    return one / two


def by_dask(jobs: list[Entry], home: Path) -> float:
    """Return how much faster two workers of a cluster are than one, though one is killed."""
    from distributed import LocalCluster

    seconds = {}
    for workers in (2, 1):
        begin = time.perf_counter()
        with LocalCluster(
            n_workers=workers, threads_per_worker=1, dashboard_address=None, memory_limit=0
        ) as cluster:
            started = time.perf_counter() - begin
            with Cluster(cluster.scheduler_address) as engine:
                pids = [worker.pid for worker in cluster.workers.values()]
                title = "two Dask workers, one killed" if workers == 2 else "one Dask worker"
                victim = (lambda pid=pids[0]: pid) if workers == 2 else None
                folder = home / f"d{workers}"
                taken = measure(title, jobs, folder, lambda _, e=engine: nullcontext(e), victim)
        seconds[workers] = started + taken
    return seconds[1] / seconds[2]


def main() -> None:
    """Print a line for each batch, and the ratios."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    resolution = sys.argv[2] if len(sys.argv) > 2 else "256x192"
    with tempfile.TemporaryDirectory() as scratch:
        home = Path(scratch)
        models(count, home / "models")
        flags = {"resolution": resolution, "up": "z"}
        asked = wanted([str(home / "models")], home / "none")
        jobs = entries(asked, flags, {}, "relief")
        best = ceiling()
        for name, way in (("processes", by_processes), ("Dask", by_dask)):
            ratio = way(jobs, home)
            after = ceiling()
            print(f"{name}: {ratio:.2f} times as fast (counting: {best:.2f}, then {after:.2f})\n")
            best = after


if __name__ == "__main__":
    main()
