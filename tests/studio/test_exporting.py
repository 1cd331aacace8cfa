"""Exports are whole or not at all, and the command line makes the same."""

import json
import threading
from dataclasses import replace

import pytest

from relieffab.cli.main import run
from relieffab.job.settings import resolve
from relieffab.studio.children import Children
from relieffab.studio.exporting import BusyError, Exporter
from relieffab.studio.session import Session

SMALL = {
    "size": "40x30mm",
    "margin": "3mm",
    "depth": "1.5mm",
    "resolution": "96x72",
    "scallop": "0.05mm",
    "view": "front",
    "up": "y",
}


class Heard:
    def __init__(self):
        self.states, self.news = [], threading.Condition()

    def __call__(self, fact):
        with self.news:
            self.states.append(fact["export"])
            self.news.notify_all()

    def wait(self, *names):
        with self.news:
            done = self.news.wait_for(
                lambda: any(s["state"] in names or s.get("stage") in names for s in self.states),
                180,
            )
        assert done, self.states
        return self.states[-1]


@pytest.fixture
def heard():
    return Heard()


@pytest.fixture
def exporter(tmp_path, heard):
    children = Children()
    exporter = Exporter(tmp_path / "jobs", children, heard)
    yield exporter
    exporter.cancel()
    children.close()


def job_file(opened, ball, **typed):
    session = Session(resolve([("test", {**SMALL, **typed})]))
    session.open(replace(opened, file=ball), up="y")
    session.close()
    return session.job_file("model")


def settled(exporter):
    """Wait until the exporter's thread has done with everything."""
    exporter._thread.join(60)


def test_an_export_is_what_the_command_line_makes_of_its_job_file(
    opened, ball, exporter, heard, tmp_path, monkeypatch
):
    first = exporter.start(job_file(opened, ball), ball)
    assert first["state"] == "running"
    with pytest.raises(BusyError, match="a job is being made"):
        exporter.start(job_file(opened, ball), ball)
    done = heard.wait("done", "failed")
    assert done["state"] == "done", done
    folder = tmp_path / "jobs" / "ball"
    listed = {part["name"]: part["bytes"] for part in done["files"]}
    assert listed == {
        str(p.relative_to(folder)): p.stat().st_size for p in folder.rglob("*") if p.is_file()
    }
    wanted = {
        "relief.tiff",
        "panel.stl",
        "01-rough.nc",
        "report.json",
        "job.toml",
        "model/ball.obj",
    }
    assert wanted | {"layers/lines.svg"} <= set(listed)
    assert done["command"] == f"relieffab make {folder / 'job.toml'} -o FOLDER"
    stages = {s["stage"] for s in heard.states if s["state"] == "running"}
    assert {"model", "layers", "relief", "panel", "toolpaths", "verify"} <= stages
    again = tmp_path / "again"
    monkeypatch.chdir(folder)
    assert run(["make", "job.toml", "-o", str(again)]) == 0
    for name in ("relief.tiff", "02-finish.nc", "panel.stl", "layers/lines.svg"):
        assert (folder / name).read_bytes() == (again / name).read_bytes(), name
    assert json.loads((folder / "report.json").read_text())["settings"]["model"] == "model/ball.obj"
    assert exporter.file("layers/lines.svg") == folder / "layers" / "lines.svg"
    for name in ("../ball/job.toml", "/etc/passwd", "layers", "", "nothing.stl", "./job.toml"):
        with pytest.raises(Exception, match="no such file"):
            exporter.file(name)
    settled(exporter)
    exporter.start(job_file(opened, ball), ball)
    assert exporter.folder == tmp_path / "jobs" / "ball-2"


def test_a_cancelled_export_leaves_nothing(opened, ball, exporter, heard, tmp_path):
    exporter.start(job_file(opened, ball, resolution="1024x768"), ball)
    heard.wait("layers")
    exporter.cancel()
    assert heard.states[-1] == exporter.state == {"state": "cancelled"}
    assert not exporter.running
    assert list(tmp_path.rglob("*")) == []
    assert exporter._children.running == 0


def test_a_failed_export_says_why_and_leaves_nothing(opened, ball, exporter, heard, tmp_path):
    exporter.start(job_file(opened, ball, machine="nonsense"), ball)
    failed = heard.wait("failed", "done")
    assert failed["error"]["message"] == "no machine 'nonsense'"
    settled(exporter)
    assert list(tmp_path.rglob("*")) == []


def test_a_job_that_dies_is_told(opened, ball, exporter, heard, tmp_path):
    exporter.start(job_file(opened, ball, resolution="1024x768"), ball)
    heard.wait("model")
    exporter._process.kill()
    failed = heard.wait("failed", "done")
    assert "ended before it was done" in failed["error"]["message"]
    settled(exporter)
    assert list(tmp_path.rglob("*")) == []


def test_a_folder_that_cannot_be_written_is_told(opened, ball, exporter, heard, tmp_path):
    (tmp_path / "jobs").write_text("a file")
    with pytest.raises(Exception, match="a file, not a folder"):
        exporter.start(job_file(opened, ball), ball)
    assert not exporter.running


def test_what_was_never_made_has_no_files(exporter):
    with pytest.raises(Exception, match="no such file"):
        exporter.file("relief.tiff")
