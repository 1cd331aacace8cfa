import tomllib
from dataclasses import replace

import pytest

from relieffab.errors import InputError
from relieffab.job.load import gather
from relieffab.job.settings import resolve
from relieffab.job.table import TABLE
from relieffab.studio import controls
from relieffab.studio.session import Session


@pytest.fixture
def session(opened):
    session = Session(resolve([("test", {"depth": "2mm", "machine": "shapeoko-3"})]))
    session.open(opened)
    yield session
    session.close()


def test_settings_are_laid_over_those_before(session):
    ask = session.settle({"depth": "3mm"})
    assert (ask.job.depth, ask.job.machine) == (3.0, "shapeoko-3")
    assert session.settle({"line_width": "1mm"}).job.depth == 3.0
    assert session.texts["depth"] == "3mm"


@pytest.mark.parametrize(
    ("given", "setting"),
    [
        ({"depth": "deep"}, "depth"),
        ({"depth": "-1mm"}, "depth"),
        ({"depth": "99mm"}, "depth"),
        ({"depth": 3}, "depth"),
        ({"size": "1mm"}, "size"),
        ({"line_kinds": "outline,nonsense"}, None),
        ({"depth": "1" * 1000}, "depth"),
    ],
)
def test_what_cannot_be_read_names_the_setting_and_changes_nothing(session, given, setting):
    before = dict(session.texts)
    with pytest.raises(InputError) as told:
        session.settle({"thickness": "20mm", **given})
    if setting:
        assert told.value.parts["where"] == setting
    assert session.texts == before


@pytest.mark.parametrize("name", ["model", "paper", "nonsense", "../x"])
def test_what_is_not_offered_is_refused(session, name):
    with pytest.raises(InputError, match="no such setting in the studio"):
        session.settle({name: "/etc/passwd"})


def test_without_a_model_nothing_can_be_asked():
    empty = Session(resolve([]))
    for ask in (lambda: empty.settle({}), empty.job_file):
        with pytest.raises(InputError, match="no model is open"):
            ask()
    empty.close()
    assert not empty.scratch.exists()


def test_the_job_file_says_all_that_is_seen(session, tmp_path, monkeypatch):
    session.settle({"depth": "2.5mm", "frame": "8mm", "holes": "10x80mm, 110x80mm"})
    path = tmp_path / "job.toml"
    path.write_text(session.job_file(), encoding="utf-8")
    read = tomllib.loads(path.read_text(encoding="utf-8"))
    assert read.pop("model") == "bumps.obj"
    assert read == session.texts
    # Whatever else this user has configured.
    configuration = tmp_path / "relieffab" / "config.toml"
    configuration.parent.mkdir()
    configuration.write_text('depth = "1mm"\nbed = "200x200mm"\n')
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    chosen = gather({}, path, {})
    assert {name: chosen[name].text for name in controls.OFFERED} == session.texts
    assert chosen["model"].text == str(tmp_path / "bumps.obj")


def test_texts_of_all_kinds_stay_what_they_are_in_a_job_file(session):
    for text in ('a"b', "a\\b", "a\nb\x00\x7f", "größe 日本", "'''", "#", '"""'):
        session.texts["machine"] = text
        assert tomllib.loads(session.job_file())["machine"] == text


def test_a_model_of_any_name_is_named_in_a_job_file(session, opened, tmp_path):
    session.open(replace(opened, file=tmp_path / 'my "horse".ply'))
    assert tomllib.loads(session.job_file())["model"] == 'my "horse".ply'
    assert tomllib.loads(session.job_file("model"))["model"] == 'model/my "horse".ply'


def test_opening_another_model_takes_the_one_before_away(session, opened):
    places = [session.new_place() for _ in range(2)]
    for place in places:
        (place / "m.obj").write_text("x")
        session.open(replace(opened, file=place / "m.obj"))
    assert not places[0].exists()
    assert places[1].exists()
    session.open(opened, up="y")
    assert list(session.scratch.iterdir()) == []
    assert session.texts["up"] == "y"


def test_a_file_of_the_persons_own_stays(session, opened, tmp_path):
    own = tmp_path / "own" / "m.obj"
    own.parent.mkdir()
    own.write_text("x")
    session.open(replace(opened, file=own))
    session.open(opened)
    assert own.exists()


def test_which_way_is_up_is_the_models_unless_it_is_said(session, opened):
    assert session.settle({}).job.up == opened.up
    assert session.settle({"up": "z"}).job.up == "z"


def test_settings_of_another_kind_of_model_are_left_out_of_the_job(session, opened, picture):
    session.settle({"azimuth": "30deg", "image_depth": "9mm"})
    assert session.settle({}).job.image_depth is None
    session.open(picture, image="depth")
    ask = session.settle({"image_depth": "9mm"})
    assert (ask.job.azimuth, ask.job.up, ask.job.image, ask.job.image_depth) == (
        None, None, "depth", 9.0,
    )  # fmt: skip
    read = tomllib.loads(session.job_file())
    assert (read["model"], read["azimuth"], read["image_depth"]) == ("bump.png", "", "9mm")
    session.open(opened)
    assert session.settle({}).job.azimuth == 30.0
    assert session.texts["image_depth"] == session.texts["image"] == ""


def test_a_mask_is_one_of_those_sent_and_goes_with_its_picture(session, opened, picture):
    session.open(picture)
    with pytest.raises(InputError, match="no such mask") as told:
        session.settle({"mask": "/etc/passwd"})
    assert told.value.parts["where"] == "mask"
    places = [session.place_of_mask("bump.png") for _ in range(2)]
    assert [place.name for place in places] == ["bump-1.png", "bump-1.png"]
    mask = replace(picture, file=places[0])
    assert session.take_mask(mask) == "bump-1.png"
    assert session.place_of_mask("bump.png").name == "bump-2.png"
    assert session.settle({}).mask is mask
    assert session.settle({"mask": ""}).mask is None
    assert session.settle({"mask": "bump-1.png"}).mask is mask
    assert tomllib.loads(session.job_file("model"))["mask"] == "model/bump-1.png"
    session.open(opened)
    assert session.texts["mask"] == ""
    assert not places[0].parent.exists()


def test_what_the_page_cannot_show_is_refused_before_it_opens():
    left_out = set(TABLE) - set(controls.OFFERED) - {"model", "paper"}
    assert left_out == {"curved", "text", "depth_map"}
    assert len(set(controls.OFFERED)) == len(controls.OFFERED)
    with pytest.raises(InputError, match="cannot show curved") as refused:
        Session(resolve([("flag", {"curved": "60mm"})]))
    assert refused.value.parts["where"] == "flag"
