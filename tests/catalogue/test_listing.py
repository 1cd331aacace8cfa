from pathlib import Path

import pytest

from relieffab.catalogue.listing import wanted
from relieffab.errors import InputError


def test_a_folder_is_walked_but_not_what_jobs_have_left(tmp_path):
    for name in (
        *("b.STL", "a.ply", "deep/er/c.obj", "notes.txt", "list.csv", ".hidden.ply", ".dir/x.ply"),
        *("made/report.json", "made/panel.stl", "out/y.ply", "pyproject.toml"),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "d.stl").mkdir()
    found = wanted([str(tmp_path)], tmp_path / "out")
    assert [job.model.removeprefix(f"{tmp_path}/") for job in found] == [
        "a.ply",
        "b.STL",
        "deep/er/c.obj",
    ]


def test_pictures_are_models_where_there_is_no_mesh(tmp_path):
    (tmp_path / "b.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    for name in ("a.png", "c.jpg", "figure.png"):
        (tmp_path / name).write_bytes(b"\x89PNG\r\n\x1a\n........")
    (tmp_path / "job.toml").write_text('model = "a.png"\nmask = "figure.png"')
    (tmp_path / "notes.txt").touch()
    found = wanted([str(tmp_path)], tmp_path / "out")
    assert [Path(job.model).name for job in found] == ["a.png", "b.svg", "c.jpg"]
    (tmp_path / "model.ply").touch()
    found = wanted([str(tmp_path)], tmp_path / "out")
    assert [Path(job.model).name for job in found] == ["a.png", "model.ply"]


def test_a_job_file_speaks_for_its_model(tmp_path):
    (tmp_path / "a.ply").touch()
    (tmp_path / "b.ply").touch()
    (tmp_path / "job.toml").write_text('model = "a.ply"')
    (tmp_path / "bad.toml").write_text("= 3")
    bad, job, bare = wanted([str(tmp_path)], tmp_path / "out")
    assert "cannot be read" in bad.fault
    assert (job.name, job.model) == ("job", str(tmp_path / "a.ply"))
    assert bare.model == str(tmp_path / "b.ply")


def test_models_may_be_named_one_by_one(tmp_path):
    for name in ("a.ply", "b.obj"):
        (tmp_path / name).touch()
    found = wanted([str(tmp_path / "b.obj"), str(tmp_path / "a.ply")], tmp_path / "out")
    assert [job.model[-5:] for job in found] == ["b.obj", "a.ply"]


@pytest.mark.parametrize(
    ("name", "told"),
    [("none", "no such folder"), ("a.doc", "neither"), ("empty", "nothing to carve")],
)
def test_what_holds_no_jobs_is_refused(tmp_path, name, told):
    (tmp_path / "a.doc").touch()
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match=told):
        wanted([str(tmp_path / name)], tmp_path / "out")
