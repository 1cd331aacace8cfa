from concurrent.futures import Future
from pathlib import Path

import pytest

from relieffab.catalogue.engine import outcomes
from relieffab.catalogue.task import Fault, Task


def task(name, memory=1):
    return Task(name, {}, "relief", "", Path(), "", memory)


class Scripted:
    """Carries tasks out at once; `script` says by name what becomes of each try."""

    tries = 3

    def __init__(self, room=10, **script):
        self.room, self.script, self.seen, self.most = room, script, [], 0

    def free(self, running):
        return self.room - sum(t.memory for t in running)

    def submit(self, task):
        self.seen.append((task.name, task.memory))
        future, way = Future(), self.script.get(task.name, [])
        become = way.pop(0) if way else {"done": task.name}
        future.death = become if isinstance(become, str) else ""
        if isinstance(become, Exception):
            future.set_exception(become)
        else:
            future.set_result(become)
        return future

    def trim(self, running):
        pass

    def settle(self, future):
        return future.death


def test_a_job_whose_worker_dies_is_begun_again_with_more_memory():
    engine = Scripted(a=["killed", "killed"])
    found = {
        t.name: (result, tries) for t, result, tries in outcomes([task("a"), task("b")], engine)
    }
    assert found == {"a": ({"done": "a"}, 3), "b": ({"done": "b"}, 1)}
    assert [memory for name, memory in engine.seen if name == "a"] == [1, 2, 4]


def test_a_job_that_kills_every_worker_fails_in_the_end():
    engine = Scripted(a=["killed"] * 9)
    found = {
        t.name: (result, tries) for t, result, tries in outcomes([task("a"), task("b")], engine)
    }
    assert found["b"] == ({"done": "b"}, 1)
    assert found["a"][1] == 3
    assert found["a"][0].message.startswith("killed")


def test_memory_set_aside_is_never_more_than_there_is():
    engine = Scripted(a=["killed", "killed"])
    list(outcomes([task("a", 6)], engine))
    assert [memory for _, memory in engine.seen] == [6, 10, 10]


def test_a_job_too_large_for_the_memory_is_not_begun():
    engine = Scripted(room=10)
    found = {t.name: result for t, result, _ in outcomes([task("a", 11), task("b", 10)], engine)}
    assert "more memory than it may" in found["a"].message
    assert found["b"] == {"done": "b"}
    assert engine.seen == [("b", 10)]


def test_a_fault_of_the_program_fails_its_job_alone():
    engine = Scripted(a=[ValueError("singular")])
    found = {t.name: result for t, result, _ in outcomes([task("a"), task("b")], engine)}
    assert "ValueError: singular" in found["a"].message
    assert "ValueError: singular" in found["a"].trace
    assert found["b"] == {"done": "b"}


def test_a_fault_comes_through_as_it_is():
    assert [r for _, r, _ in outcomes([task("a")], Scripted(a=[Fault("no")]))] == [Fault("no")]


def test_who_heeds_may_stop_it():
    def stop():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(outcomes([task("a")], Scripted(), stop))
