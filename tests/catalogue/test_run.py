import json
from concurrent.futures import Future
from contextlib import contextmanager

import numpy as np
import pytest

from relieffab.catalogue import run
from relieffab.catalogue.entries import entries
from relieffab.catalogue.listing import wanted
from relieffab.catalogue.lock import locked
from relieffab.catalogue.work import carry_out
from relieffab.errors import InputError
from relieffab.picture import png16


class Here:
    """Carries tasks out in this process, one after the other."""

    room, tries = 1 << 40, 1

    def __init__(self):
        self.begun = []

    def free(self, running):
        return -1 if running else self.room

    def submit(self, task):
        self.begun.append(task.name)
        future = Future()
        future.set_result(carry_out(task))
        return future

    def trim(self, running):
        pass

    def settle(self, future):
        return ""

    @contextmanager
    def opened(self, tasks):
        yield self


def batch(stones, stage="relief", **more):
    jobs, out = stones
    engine = Here()
    return run.batch(jobs, out, stage, engine.opened, **more), engine.begun


def test_what_is_done_is_kept_and_what_changed_is_made_again(stones, tmp_path):
    jobs, out = stones
    three = jobs[:3], out
    first, begun = batch(three)
    assert (first["done"], begun) == (3, ["stone-0", "stone-1", "stone-2"])
    again, begun = batch(three)
    assert (again["kept"], again["done"], begun) == (3, 0, [])
    model = tmp_path / "stones" / "stone-1.ply"
    model.write_bytes((tmp_path / "stones" / "stone-7.ply").read_bytes())
    (out / "stone-2" / "report.json").unlink()
    more, begun = batch(three)
    assert (more["kept"], more["done"], begun) == (1, 2, ["stone-1", "stone-2"])
    assert json.loads((out / "batch.json").read_text())["kept"] == 1


def test_failures_stand_beside_what_is_done(stones, tmp_path):
    _, out = stones
    models = tmp_path / "stones"
    (models / "empty.stl").touch()
    (models / "bad.toml").write_text('model = "stone-0.ply"\ndepth = "deep"')
    jobs = entries(wanted([str(models)], out), {"resolution": "96x72", "up": "z"}, {}, "layers")
    told = []
    found, begun = batch((jobs[:4], out), "layers", tell=told.append)
    status = {row["name"]: row["status"] for row in found["jobs"]}
    assert status == {"bad": "failed", "empty": "failed", "stone-1": "done", "stone-2": "done"}
    assert told[0]["name"] == "bad"
    assert "empty" in begun
    messages = {row["name"]: row.get("message", "") for row in found["jobs"]}
    assert messages["empty"].startswith("the model file is empty")
    assert "depth" in messages["bad"]
    assert not (out / "empty").exists()


def test_a_stop_leaves_what_is_done_and_says_so(stones):
    jobs, out = stones

    def stop(stage, done, total, unit=""):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as stopped:
        batch((jobs[:4], out), progress=stop)
    assert "2 of 4 jobs done" in stopped.value.__notes__[0]
    whole = json.loads((out / "batch.json").read_text())
    assert (whole["done"], whole["waiting"]) == (2, 2)
    assert "2 not yet made" in (out / "index.html").read_text()
    assert [p.name for p in out.rglob(".*")] == []
    found, _ = batch((jobs[:4], out))
    assert (found["kept"], found["done"]) == (2, 2)


def test_scraps_of_jobs_that_were_cut_off_are_swept(stones):
    jobs, out = stones
    batch((jobs[:1], out), "layers")
    for scrap in (out / ".stone-0-abcd1234", out / "stone-0" / ".stone-0-x_yz9876"):
        (scrap / "layers").mkdir(parents=True)
    (out / ".mine").mkdir()
    batch((jobs[:1], out), "layers")
    assert [p.name for p in out.rglob(".*")] == [".mine"]


def test_two_batches_at_once_are_refused(stones):
    jobs, out = stones
    batch((jobs[:1], out), "layers")
    with locked(out), pytest.raises(InputError, match="another batch"):
        batch((jobs[:1], out), "layers")


def test_a_list_of_round_marked_and_pictured_jobs(tmp_path):
    down, across = np.mgrid[-1:1:72j, -1:1:96j]
    dome = np.sqrt(np.clip(1 - (across**2 + down**2) / 0.6, 0, 1))
    (tmp_path / "dome.png").write_bytes(png16(dome))
    (tmp_path / "list.csv").write_text(
        "model,name,round,style,resolution\n"
        "dome.png,flat,,,96x72\ndome.png,column,20mm,,96x72\n"
        "dome.png,marked,,gouge,200x150\ndome.png,narrow,5mm,,96x72\n"
    )
    flags = {"size": "40x30mm", "margin": "3mm", "depth": "2mm"}
    listed = wanted([str(tmp_path / "list.csv")], tmp_path / "out")
    jobs = entries(listed, flags, {}, "relief")
    found, _ = batch((jobs, tmp_path / "out"))
    rows = {row["name"]: row for row in found["jobs"]}
    assert (found["done"], found["failed"]) == (3, 1)
    assert "wider than the way round" in rows["narrow"]["message"]
    page = (tmp_path / "out" / "column" / "report.html").read_text(encoding="utf-8")
    assert "round, 20 mm thick, 30 mm long" in page
    page = (tmp_path / "out" / "marked" / "report.html").read_text(encoding="utf-8")
    assert "<h2>Marks</h2>" in page
