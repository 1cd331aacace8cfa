import hashlib
import json

import pytest

from relieffab import profiles
from relieffab.catalogue import identity
from relieffab.catalogue.identity import finished, key_of
from relieffab.job.load import layered


def key(**values):
    return key_of(layered({"model": "a.ply", **values}, {}, []))


def test_the_same_settings_are_the_same_however_they_are_typed():
    assert key(depth="3mm") == key(depth="0.3cm", model="elsewhere/b.obj") == key()
    assert len({key(), key(depth="3.1mm"), key(view="left"), key(machine="minimill")}) == 4


def test_another_version_and_another_profile_are_another_job(monkeypatch):
    before = key()
    wood = profiles.material("softwood")
    with monkeypatch.context() as changed:
        changed.setattr(identity, "__version__", "9")
        assert key() != before
    from dataclasses import replace

    monkeypatch.setattr(identity.profiles, "material", lambda _: replace(wood, title="oak"))
    assert key() != before


@pytest.mark.parametrize("setting", ["mask", "depth_map"])
def test_a_picture_beside_the_model_counts_by_what_is_in_it(tmp_path, setting):
    mask, copy = tmp_path / "mask.png", tmp_path / "copy.png"
    mask.write_bytes(b"a figure")
    copy.write_bytes(b"a figure")
    before = key(**{setting: str(mask)})
    assert before == key(**{setting: str(copy)}) != key()
    mask.write_bytes(b"another")
    assert before != key(**{setting: str(mask)})


@pytest.fixture
def left(tmp_path):
    """A model, and the folder of its relief."""
    (tmp_path / "a.ply").write_bytes(b"ply")
    report = {
        "schema": 1,
        "settings": {},
        "model": {"sha256": hashlib.sha256(b"ply").hexdigest()},
        "batch": {"key": "k", "stage": "relief"},
    }
    (tmp_path / "report.json").write_text(json.dumps(report))
    return tmp_path


def test_finished_to_a_stage_is_finished_to_those_before(left):
    asked = {stage: finished(left, stage, "k", left / "a.ply") for stage in identity.STAGES}
    assert [asked[stage] is not None for stage in identity.STAGES] == [True, True, False]


def test_what_was_changed_is_not_finished(left):
    assert finished(left, "relief", "other", left / "a.ply") is None
    assert finished(left, "relief", "k", left / "none.ply") is None
    (left / "a.ply").write_bytes(b"ply ")
    assert finished(left, "relief", "k", left / "a.ply") is None


def test_a_report_that_is_broken_or_not_of_a_batch_is_not_finished(left):
    (left / "report.json").write_text('{"schema": 1, "settings": {}, "model": {}}')
    assert finished(left, "relief", "k", left / "a.ply") is None
    (left / "report.json").write_text('{"schema": 1')
    assert finished(left, "relief", "k", left / "a.ply") is None
