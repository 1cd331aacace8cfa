import tomllib

import pytest

from relieffab.errors import InputError
from relieffab.job import load


@pytest.fixture(autouse=True)
def no_user_configuration(tmp_path, monkeypatch):
    monkeypatch.setattr(load, "user_configuration", lambda: tmp_path / "user" / "config.toml")


def test_flag_beats_environment_beats_file_beats_user_beats_default(tmp_path):
    (tmp_path / "user").mkdir()
    (tmp_path / "user" / "config.toml").write_text('depth = "1mm"\nmargin = "1mm"\nup = "y"\n')
    job = tmp_path / "job.toml"
    job.write_text('depth = "2mm"\nmargin = "2mm"\nview = "left"\n')
    chosen = load.gather({"depth": "4mm"}, job, {"RELIEFFAB_DEPTH": "3mm", "RELIEFFAB_ROLL": "5"})
    assert chosen["depth"].value == 4.0
    assert chosen["roll"].origin == "RELIEFFAB_ROLL"
    assert chosen["margin"].value == 2.0
    assert chosen["view"].value == "left"
    assert chosen["up"].origin == str(tmp_path / "user" / "config.toml")
    assert chosen["size"].origin == "default"


def test_a_job_files_model_lies_beside_it(tmp_path):
    (tmp_path / "job.toml").write_text('model = "horse.ply"\n')
    chosen = load.gather({}, tmp_path / "job.toml", {})
    assert chosen["model"].value == str(tmp_path / "horse.ply")


def test_the_template_is_a_job_of_defaults(tmp_path):
    path = tmp_path / "job.toml"
    path.write_text(load.template())
    assert "depth" in tomllib.loads(load.template())
    from_file, by_default = (load.gather({}, p, {}) for p in (path, None))
    assert {k: c.value for k, c in from_file.items()} == {k: c.value for k, c in by_default.items()}


def test_files_that_are_no_jobs_are_refused(tmp_path):
    with pytest.raises(InputError, match="no such job file"):
        load.read_toml(tmp_path / "none.toml")
    (tmp_path / "bad.toml").write_text("size = = 3")
    with pytest.raises(InputError, match="cannot be read"):
        load.read_toml(tmp_path / "bad.toml")
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="cannot be read"):
        load.read_toml(tmp_path / "binary.toml")
