import threading

import pytest

from relieffab.studio.worker import SupersededError, Worker


@pytest.fixture
def worker():
    worker = Worker()
    yield worker
    worker.close()


class Held:
    """Work that goes on until it is let go, telling of itself."""

    def __init__(self):
        self.began, self.go = threading.Event(), threading.Event()

    def __call__(self, progress):
        self.began.set()
        while not self.go.wait(0.01):
            progress("held", 0, 1)
        return "held"


def test_work_gives_its_result_and_its_fault(worker):
    assert worker.ask("preview", lambda progress: 42).result(5) == 42

    def fail(progress):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        worker.ask("preview", fail).result(5)
    assert worker.ask("preview", lambda progress: "on").result(5) == "on"


def test_the_newest_of_a_kind_wins_over_what_is_in_work_and_what_waits(worker):
    held = Held()
    first = worker.ask("preview", held)
    held.began.wait(5)
    second = worker.ask("preview", lambda progress: 2)
    third = worker.ask("preview", lambda progress: 3)
    for old in (first, second):
        with pytest.raises(SupersededError):
            old.result(5)
    assert third.result(5) == 3


def test_a_result_that_was_overtaken_at_its_end_is_not_given_out(worker):
    newer = []

    def slow(progress):
        newer.append(worker.ask("preview", lambda progress: "new"))
        return "old"

    with pytest.raises(SupersededError):
        worker.ask("preview", slow).result(5)
    assert newer[0].result(5) == "new"


def test_other_kinds_wait_in_the_order_of_their_urgency(worker):
    held, order = Held(), []
    first = worker.ask("toolpaths", held)
    held.began.wait(5)
    asks = [
        worker.ask(kind, lambda progress, kind=kind: order.append(kind))
        for kind in ("warm", "panel", "preview", "carved")
    ]
    held.go.set()
    for ask in asks:
        ask.result(5)
    assert first.result(5) == "held"
    assert order == ["carved", "preview", "panel", "warm"]


def test_an_ask_drops_what_it_makes_void(worker):
    held = Held()
    old = worker.ask("toolpaths", held)
    held.began.wait(5)
    new = worker.ask("preview", lambda progress: "new", drops=("toolpaths",))
    assert new.result(5) == "new"
    with pytest.raises(SupersededError):
        old.result(5)


def test_work_for_somebody_who_went_is_left_and_harms_nobody(worker):
    held = Held()
    gone = worker.ask("preview", held)
    held.began.wait(5)
    assert gone.cancel()
    assert worker.ask("panel", lambda progress: "on").result(5) == "on"
    other = worker.ask("preview", Held())
    assert other.cancel()
    assert worker.ask("preview", lambda progress: "on").result(5) == "on"


def test_progress_is_told_to_who_asked(worker):
    told = []

    def work(progress):
        progress("stage", 1, 2, "mm")

    worker.ask("panel", work, report=lambda *word: told.append(word)).result(5)
    assert told[0] == ("stage", 1, 2, "mm")


def test_a_closed_worker_drops_everything_and_takes_nothing(worker):
    held = Held()
    asks = [worker.ask("preview", held)]
    held.began.wait(5)
    asks.append(worker.ask("panel", lambda progress: 1))
    worker.close()
    asks.append(worker.ask("panel", lambda progress: 2))
    for ask in asks:
        with pytest.raises(SupersededError):
            ask.result(5)
