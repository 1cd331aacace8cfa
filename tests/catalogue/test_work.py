import json
from dataclasses import replace

import pytest

from relieffab.catalogue.lock import locked
from relieffab.catalogue.task import Fault, Task
from relieffab.catalogue.work import carry_out
from relieffab.job import run


@pytest.fixture
def task(stones):
    (entry, *_), out = stones
    out.mkdir()
    with locked(out) as token:
        yield Task(entry.name, entry.settings, "relief", entry.key, out, token, 0)


def test_a_job_leaves_what_its_command_would_and_what_the_batch_needs(task):
    report = carry_out(task)
    assert report == json.loads((task.folder / "report.json").read_text())
    assert report["batch"]["key"] == task.key
    found = {p.name for p in task.folder.iterdir()}
    assert found == {
        *("layers", "relief.png", "relief.tiff", "preview.png"),
        *("report.json", "report.html", "thumbnail.jpg"),
    }
    assert [p.name for p in task.catalogue.iterdir() if p.name.startswith(".")] == [".batch-lock"]


def test_what_is_finished_is_not_made_again(task, monkeypatch):
    monkeypatch.setattr(run, "make_relief", _once(run.make_relief))
    before = carry_out(task)
    assert carry_out(task) == before
    assert isinstance(carry_out(replace(task, stage="layers")), dict)


def _once(function):
    calls = []

    def call(*args, **named):
        calls.append(args)
        assert len(calls) == 1
        return function(*args, **named)

    return call


def test_what_a_person_has_put_beside_stays(task):
    task.folder.mkdir()
    (task.folder / "photo.jpg").write_bytes(b"mine")
    carry_out(task)
    assert (task.folder / "photo.jpg").read_bytes() == b"mine"


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"token": "other"}, "the batch has ended"),
        ({"key": "other"}, "something else of the job"),
    ],
)
def test_a_worker_that_cannot_do_the_same_refuses(task, change, told):
    found = carry_out(replace(task, **change))
    assert isinstance(found, Fault)
    assert told in found.message
    assert not task.folder.exists()


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (OSError(28, "No space left on device", "relief.tiff"), "No space left on device"),
        (MemoryError(), "not enough memory"),
    ],
)
def test_what_befalls_a_job_is_told(task, monkeypatch, error, told):
    def fail(*args, **named):
        raise error

    monkeypatch.setattr(run, "make_relief", fail)
    assert told in carry_out(task).message
    assert not task.folder.exists()


def test_a_job_stops_when_its_batch_has_ended(task, monkeypatch):
    def make(settings, folder, *, progress):
        (task.catalogue / ".batch-lock").unlink()
        progress("relief", 1, 2)

    monkeypatch.setattr(run, "make_relief", make)
    assert "the batch has ended" in carry_out(task).message
