import json
import os
import signal
import subprocess
import sys

import pytest
import trimesh

from relieffab.cli.batch import line
from relieffab.cli.main import run

TINY = ["--resolution", "96x72", "--size", "40x30mm", "--margin", "3mm", "--depth", "1.5mm"]
ASKED = ["--stage", "layers", "--up", "z", *TINY]


def stones(folder, count):
    folder.mkdir(exist_ok=True)
    for k in range(count):
        trimesh.creation.icosphere(subdivisions=2, radius=1 + k).export(folder / f"s{k}.stl")
    return folder


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with traps, and the catalogue of it."""
    home = tmp_path_factory.mktemp("batch")
    models = stones(home / "models", 2)
    (models / "empty.ply").touch()
    (models / "points.obj").write_text("v 0 0 0\nv 1 0 0\n")
    status = run(["batch", str(models), "-o", str(home / "out"), "--workers", "1", *ASKED])
    return models, home / "out", status


def test_a_folder_with_traps_ends_with_all_others_done(made):
    _, out, status = made
    assert status == 1
    whole = json.loads((out / "batch.json").read_text())
    assert (whole["done"], whole["failed"]) == (2, 2)
    assert sorted(p.name for p in out.iterdir()) == ["batch.json", "index.html", "s0", "s1"]


def test_a_second_run_keeps_what_is_done_and_prints_a_line_each(made, capsys):
    models, out, _ = made
    one, other = str(models / "s0.stl"), str(models / "s1.stl")
    assert run(["batch", one, other, "-o", str(out), *ASKED]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].split() == [
        "1",
        "of",
        "2",
        "s0",
        "kept",
        "40",
        "x",
        "30",
        "mm,",
        "layers",
        "only",
    ]
    assert printed[1].startswith("2 of 2  s1")
    assert "2 jobs: 2 done before" in printed


def test_json_is_all_that_stdout_holds(made, capsys):
    models, out, _ = made
    assert run(["batch", str(models / "s0.stl"), "-o", str(out), *ASKED, "--json"]) == 0
    printed = capsys.readouterr()
    assert json.loads(printed.out) == json.loads((out / "batch.json").read_text())
    assert "1 of 1  s0" in printed.err


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (["--workers", "0"], "there must be a worker"),
        (["--memory", "4"], "not a size of memory"),
        (["--memory", "4 apples"], "unknown unit"),
        (["--stage", "all"], "all"),
        (["--depth", "deep"], "depth"),
        (["--scheduler", "tcp://h:1", "--workers", "2"], "this machine"),
        (["--scheduler", "tcp://h:1", "--memory", "2GB"], "this machine"),
    ],
)
def test_bad_usage_is_refused_before_anything_is_made(made, tmp_path, capsys, more, told):
    models, _, _ = made
    assert run(["batch", str(models), "-o", str(tmp_path / "new"), *more]) == 2
    printed = capsys.readouterr()
    assert told in printed.err + printed.out
    assert not (tmp_path / "new").exists()


def test_without_sources_and_with_none_that_are_there(tmp_path, capsys):
    assert run(["batch", "-o", str(tmp_path)]) == 2
    assert run(["batch", str(tmp_path / "none"), "-o", str(tmp_path / "out")]) == 2
    assert "no such folder or list" in capsys.readouterr().err


def test_more_memory_than_may_be_taken(made, tmp_path, capsys):
    models, _, _ = made
    out = tmp_path / "out"
    assert run(["batch", str(models / "s0.stl"), "-o", str(out), "--memory", "200MB", *TINY]) == 1
    assert "more memory than it may" in capsys.readouterr().out
    assert sorted(p.name for p in out.iterdir()) == ["batch.json", "index.html"]


def test_without_dask_it_is_said_how_to_get_it(made, tmp_path, capsys, monkeypatch):
    models, _, _ = made
    monkeypatch.setitem(sys.modules, "distributed", None)
    asked = ["batch", str(models / "s0.stl"), "-o", str(tmp_path / "o"), *ASKED]
    assert run([*asked, "--scheduler", "tcp://127.0.0.1:9"]) == 2
    assert "relieffab[cluster]" in capsys.readouterr().err


def test_findings_and_failures_have_their_line():
    row = {
        "name": "horse", "status": "done", "size_mm": [120, 90], "findings": [], "carves": True,
        "cutting_s": 5400.0, "seconds": 12.34, "stage": "make",
    }  # fmt: skip
    assert line(row).split("  ")[-1] == (
        "120 x 90 mm, carves the relief, 1 h 30 min to cut, made in 12.3 s"
    )
    assert "has findings" in line({**row, "findings": ["too steep"]})
    failed = {"name": "x", "status": "failed", "message": "it is empty\n  try: another"}
    assert line(failed).endswith("FAILED  it is empty")


@pytest.mark.usefixtures("heard")
def test_ctrl_c_leaves_what_is_done_and_nothing_else(tmp_path):
    models = stones(tmp_path / "models", 12)
    out = tmp_path / "out"
    command = [sys.executable, "-m", "relieffab", "batch", str(models), "-o", str(out)]
    command += ["--workers", "2", *ASKED]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        first = process.stdout.readline()
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: workers hear it, too
        rest, said = process.communicate(timeout=120)
    assert first.startswith(" 1 of 12")
    assert process.returncode == 130
    assert "the same command goes on" in said
    assert "Traceback" not in said
    whole = json.loads((out / "batch.json").read_text())
    told, made = len((first + rest).splitlines()), len(list(out.glob("*/report.json")))
    assert whole["done"] == told <= made <= told + 2  # either worker may just have finished
    assert whole["waiting"] == 12 - whole["done"] > 0
    assert [p.name for p in out.rglob(".*")] == []
