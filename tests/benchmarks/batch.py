"""A batch of 200 small jobs by one worker, and by two of which one is killed midway.

    python tests/benchmarks/batch.py [JOBS] [RESOLUTION]

By processes and by a local Dask cluster, with jobs that only wait, half a second each, and with
reliefs.  The former tell what the batch itself costs, whatever else the machine has to do; of
the latter what came out is counted on the disk.  Where cores are taken, two workers cannot be twice
as fast as one: so the ratio of two processes that merely count is printed, too, and how many jobs
each worker did, which is what the time would follow on cores of their own.
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
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from distributed import LocalCluster

from relieffab.catalogue import run
from relieffab.catalogue.cluster import Cluster
from relieffab.catalogue.engine import Engine
from relieffab.catalogue.entries import Entry, entries
from relieffab.catalogue.listing import wanted
from relieffab.catalogue.processes import Processes
from relieffab.catalogue.task import Task, Work
from relieffab.catalogue.work import carry_out
from relieffab.subject import shapes

ROOM = 16 << 30
COUNTED = 30_000_000
DOZE = 0.5  # seconds


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


def doze(task: Task) -> dict[str, Any]:
    """Take the time of a job, and no core."""
    time.sleep(DOZE)
    return {
        "settings": {"size": "1x1mm"},
        "model": {},
        "batch": {"stage": task.stage, "seconds": DOZE, "worker": str(os.getpid())},
    }


class Watch:
    """Notes when each row is told, and kills a worker when half of them are."""

    def __init__(self, half: int, victim: Callable[[], int] | None) -> None:
        self.told: dict[str, list[float]] = {}
        self._half, self._victim = half, victim

    def __call__(self, row: dict[str, Any]) -> None:
        self.told.setdefault(row["name"], []).append(time.time())
        if self._victim and len(self.told) == self._half:
            os.kill(self._victim(), signal.SIGKILL)


@dataclass(frozen=True)
class Bench:
    """The jobs, what is done with each, and where results go."""

    jobs: list[Entry]
    work: Work
    home: Path

    def measure(
        self,
        title: str,
        engine: Callable[..., AbstractContextManager[Engine]],
        victim: Callable[[], int] | None = None,
    ) -> float:
        """Run a batch, print what became of it, and return its seconds."""
        watch, folder = Watch(len(self.jobs) // 2, victim), self.home / title.replace(" ", "-")
        begin = time.perf_counter()
        found = run.batch(self.jobs, folder, "relief", engine, tell=watch)
        seconds = time.perf_counter() - begin
        made = {path.parent.name: path.stat().st_mtime for path in folder.glob("*/report.json")}
        again = sum(made[name] > watch.told[name][0] for name in made)
        twice = sum(len(times) > 1 for times in watch.told.values())
        tries = Counter(row["tries"] for row in found["jobs"])
        each = sorted(Counter(row["worker"] for row in found["jobs"]).values())
        at_once = sum(row["seconds"] for row in found["jobs"]) / seconds
        print(
            f"  {title:<24} {seconds:7.1f} s  {found['done']} done, {found['failed']} failed, "
            f"{len(made)} on disk, {twice + again} twice, begun {dict(tries)}, "
            f"{' + '.join(map(str, each))} by each worker, "
            f"{at_once:.2f} at once, {len(list(folder.rglob('.*')))} scraps",
            flush=True,
        )
        return seconds

    def processes(self) -> float:
        """Return how much faster two processes are than one, though one is killed."""

        def victim() -> int:
            return multiprocessing.active_children()[0].pid or 0

        two = self.measure(
            "two, one killed", lambda _: Processes(2, ROOM, self.work), victim=victim
        )
        return self.measure("one", lambda _: Processes(1, ROOM, self.work)) / two

    def dask(self) -> float:
        """Return how much faster two workers of a cluster are than one, though one is killed."""
        seconds = {}
        for workers in (2, 1):
            with (
                LocalCluster(
                    n_workers=workers, threads_per_worker=1, dashboard_address=None, memory_limit=0
                ) as cluster,
                Cluster(cluster.scheduler_address, self.work) as engine,
            ):
                pid = next(iter(cluster.workers.values())).pid
                title = "two Dask, one killed" if workers == 2 else "one Dask"
                victim = (lambda pid=pid: pid) if workers == 2 else None
                seconds[workers] = self.measure(title, lambda _, e=engine: nullcontext(e), victim)
        return seconds[1] / seconds[2]


def main() -> None:
    """Print a line for each batch, and the ratios."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    resolution = sys.argv[2] if len(sys.argv) > 2 else "256x192"
    with tempfile.TemporaryDirectory() as scratch:
        home = Path(scratch)
        models(count, home / "models")
        asked = wanted([str(home / "models")], home / "none")
        jobs = entries(asked, {"resolution": resolution, "up": "z"}, {}, "relief")
        for kind, work in (("that wait", doze), ("that compute", carry_out)):
            bench = Bench(jobs, work, home / kind)
            for name, way in (("processes", bench.processes), ("Dask", bench.dask)):
                print(f"{count} jobs {kind}, {name}: {way():.2f} times as fast")
                print(f"  mere counting: {ceiling():.2f} times as fast", flush=True)


if __name__ == "__main__":
    main()
