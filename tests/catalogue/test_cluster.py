import os
import signal
import time

import pytest

from relieffab.catalogue import run
from relieffab.catalogue.task import Task
from relieffab.errors import InputError

distributed = pytest.importorskip("distributed", reason="the extra `cluster` is not installed")

from relieffab.catalogue.cluster import Cluster  # noqa: E402


@pytest.fixture(scope="module")
def two():
    """A cluster of two workers on this machine."""
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, memory_limit="4GiB"
    ) as cluster:
        yield cluster


def test_eight_jobs_and_a_worker_killed_midway(two, stones):
    jobs, out = stones
    pids, told = [worker.pid for worker in two.workers.values()], []

    def tell(row):
        told.append(row["name"])
        if len(told) == 3:
            os.kill(pids[0], signal.SIGKILL)

    found = run.batch(jobs, out, "relief", lambda _: Cluster(two.scheduler_address), tell=tell)
    assert sorted(told) == [f"stone-{k}" for k in range(8)]
    assert (found["done"], found["failed"]) == (8, 0)
    assert len(list(out.glob("*/report.json"))) == 8
    assert [p.name for p in out.rglob(".*")] == []


def test_a_job_that_kills_every_worker_fails_with_the_reason(two, tmp_path):
    def die(_):
        os._exit(1)

    two.scheduler.allowed_failures = 0
    with Cluster(two.scheduler_address, die) as engine:
        assert engine.room == 4 << 30
        future = engine.submit(Task("deadly", {}, "relief", "", tmp_path, "", 0))
        future.exception(timeout=120)
        assert "deadly" in engine.settle(future)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense://here"])
def test_where_no_scheduler_answers(address, monkeypatch):
    monkeypatch.setattr("relieffab.catalogue.cluster.PATIENCE", 1)
    with pytest.raises(InputError, match="no Dask scheduler answers"):
        Cluster(address)


def test_a_cluster_without_workers(monkeypatch):
    monkeypatch.setattr("relieffab.catalogue.cluster.PATIENCE", 1)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=None, processes=False) as cluster,
        pytest.raises(InputError, match="no workers"),
    ):
        Cluster(cluster.scheduler_address)


def test_a_cluster_that_loses_all_workers_says_that_it_waits_and_goes_on(tmp_path, monkeypatch):
    def work(task):
        return {"name": task.name}

    told = []
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, dashboard_address=None, memory_limit="4GiB"
        ) as local,
        Cluster(local.scheduler_address, work, told.append) as engine,
    ):
        monkeypatch.setattr("relieffab.catalogue.cluster.PATIENCE", 0.5)
        assert told == []
        local.scale(0)
        until(lambda: engine.free([]) >= 0 and told)
        for _ in range(3):
            engine.free([])
        assert len(told) == 1
        assert "lost all its workers; waiting" in told[0]
        assert local.scheduler_address in told[0]
        future = engine.submit(Task("late", {}, "relief", "", tmp_path, "", 0))
        local.scale(1)
        assert future.result(timeout=120) == {"name": "late"}
        engine.free([])
        assert told[1:] == ["the cluster has workers again"]


def until(happens):
    """Look again and again, for a minute."""
    end = time.monotonic() + 60
    while not happens():
        assert time.monotonic() < end
        time.sleep(0.1)
