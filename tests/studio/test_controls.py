import pytest

from relieffab.job.settings import default_job, resolve
from relieffab.job.table import TABLE
from relieffab.studio.controls import controls, idle, listed

CONTROLS = {control["name"]: control for control in controls()}


@pytest.mark.parametrize("name", CONTROLS)
def test_every_position_of_a_control_can_be_read(name):
    control = CONTROLS[name]
    assert control["default"] == TABLE[name].default
    assert control["label"] and control["help"] and control["group"]
    if control["kind"] == "range":
        assert control["min"] < control["max"] and control["step"] > 0
        texts = [f"{control[end]:g}{control['unit']}" for end in ("min", "max")]
    elif control["kind"] == "choice":
        assert control["default"] in [*control["choices"], ""]
        texts = control["choices"]
    else:
        assert control["kind"] in ("text", "file")
        texts = [control["default"]]
    for text in texts:
        assert resolve([("test", {name: text})])[name].text == text


def test_defaults_lie_within_their_ranges():
    job = default_job()
    for name, control in CONTROLS.items():
        value = getattr(job, name)
        if control["kind"] == "range" and value is not None:
            assert control["min"] <= value <= control["max"], name


def test_the_first_group_is_what_a_relief_is_judged_by():
    first = [c["name"] for c in controls() if c["group"] == controls()[0]["group"]]
    assert {"depth", "form_length", "line_depth", "line_width", "line_detail"} == set(first)


def test_what_has_nothing_to_say_of_a_model_rests_with_a_reason():
    assert set(idle("mesh")) == {"image", "image_depth", "mask"}
    for kind in ("photo", "depth", "normal", "drawing", "svg"):
        found = idle(kind)
        assert {"view", "azimuth", "up"} <= set(found) < set(CONTROLS)
        assert all(found.values())
        assert ("image_depth" in found) == (kind != "depth")
        assert ("mask" in found) == (kind in ("drawing", "svg"))
        assert ("form_length" in found) == (kind in ("drawing", "svg"))
        assert not {"depth", "style", "line_depth", "size"} & set(found)
    assert set(idle("mesh", bent=True)) > {"frame", "thickness", "solid"}


def test_profiles_are_named_with_words_for_people():
    found = listed()
    assert {"machines", "materials", "cutters"} == set(found)
    for entries in found.values():
        assert all(entry["name"] and entry["about"] for entry in entries)
    assert CONTROLS["machine"]["choices"] == [entry["name"] for entry in found["machines"]]
