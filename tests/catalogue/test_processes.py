import multiprocessing
import os
import signal
import time
from pathlib import Path

from relieffab.catalogue import run
from relieffab.catalogue.processes import THREADS, Processes, cores
from relieffab.catalogue.task import Task

ROOM = 8 << 30


def test_a_death_is_told_and_the_next_job_has_a_new_worker():
    with Processes(1, ROOM, signal.raise_signal) as engine:
        future = engine.submit(signal.SIGKILL)
        future.exception()
        assert "SIGKILL" in engine.settle(future)
        again = engine.submit(signal.SIGCONT)
        assert again.result() is None
        assert engine.settle(again) == ""


def test_a_worker_that_leaves_is_told_by_its_exit_status():
    with Processes(1, ROOM, os._exit) as engine:
        future = engine.submit(3)
        future.exception()
        assert "exit status 3" in engine.settle(future)


def test_a_worker_that_dies_idle_is_replaced():
    with Processes(1, ROOM, time.sleep) as engine:
        first = engine.submit(0)
        first.result()
        engine.settle(first)
        (worker,) = multiprocessing.active_children()
        worker.kill()
        worker.join()
        second = engine.submit(0)
        if second.exception() is not None:  # its death was noticed only now
            engine.settle(second)
            second = engine.submit(0)
        assert second.result() is None


def test_leaving_ends_workers_whatever_they_do():
    begin = time.monotonic()
    with Processes(2, ROOM, time.sleep) as engine:
        engine.submit(600)
        engine.submit(600)
        assert len(multiprocessing.active_children()) == 2
        assert engine.free([]) == -1
    assert multiprocessing.active_children() == []
    assert time.monotonic() - begin < 300


def test_workers_share_the_cores():
    before = dict(os.environ)
    with Processes(2, ROOM, os.getenv) as engine:
        futures = [engine.submit(name) for name in THREADS[:2]]
        assert {future.result() for future in futures} == {str(max(1, cores() // 2))}
    assert dict(os.environ) == before


def test_memory_says_how_many_run_at_once():
    def task(memory):
        return Task("", {}, "", "", None, "", memory)

    assert Processes(3, 10).free([task(6)]) == 4


def hoard(amount):
    """Take so many bytes, and keep them."""
    held = b"x" * amount
    time.sleep(600)
    return len(held)


def ended(engine, running):
    """Trim until a worker has ended; return whose."""
    while not any(future.done() for future in running):
        engine.trim(running)
        time.sleep(0.05)
    return [task.name for future, task in running.items() if future.done()]


def test_a_worker_far_above_its_share_is_ended_where_all_take_too_much():
    def task(name, memory):
        return Task(name, {}, "", "", Path(), "", memory)

    with Processes(2, 500 << 20, hoard) as engine:
        frugal, greedy = engine.submit(1 << 20), engine.submit(600 << 20)
        running = {frugal: task("frugal", 300 << 20), greedy: task("greedy", 200 << 20)}
        assert ended(engine, running) == ["greedy"]
        told = engine.settle(greedy)
        assert "200 MiB were set aside" in told
        assert "more than 500 MiB" in told


def test_workers_without_a_job_go_before_those_that_have_one():
    with Processes(2, 10 << 30, abs) as engine:
        busy, idle = engine.submit(1), engine.submit(2)
        idle.result()
        engine.settle(idle)
        engine.room = engine._busy[busy].memory() + (1 << 20)
        engine.trim({busy: Task("", {}, "", "", Path(), "", 1)})
        assert busy.result() == 1
        assert engine.settle(busy) == ""
        assert len(multiprocessing.active_children()) == 1


def test_eight_jobs_and_a_worker_killed_midway(stones):
    jobs, out = stones
    told, victims = [], []

    def tell(row):
        told.append(row["name"])
        if len(told) == 3:
            victims.extend(multiprocessing.active_children()[:1])
            os.kill(victims[0].pid, signal.SIGKILL)

    found = run.batch(jobs, out, "relief", lambda _: Processes(2, ROOM), tell=tell)
    assert len(victims) == 1
    assert sorted(told) == [f"stone-{k}" for k in range(8)]
    assert (found["done"], found["failed"], found["waiting"]) == (8, 0, 0)
    assert len(list(out.glob("*/report.json"))) == 8
    assert [p.name for p in out.rglob(".*")] == []
    assert multiprocessing.active_children() == []
