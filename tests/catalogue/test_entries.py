from pathlib import Path

import pytest

from relieffab.catalogue.entries import entries
from relieffab.catalogue.lists import Wanted
from relieffab.errors import InputError


def job(model="a.ply", **values):
    return Wanted("list.csv, line 2", model, (("list.csv, line 2", {"model": model, **values}),))


def test_a_flag_is_stronger_than_the_list_and_the_environment_too(monkeypatch):
    jobs = [job(depth="2mm", view="left", roll="3deg")]
    (entry,) = entries(jobs, {"depth": "1mm"}, {"RELIEFFAB_ROLL": "5deg"}, "relief")
    assert [entry.settings[name].value for name in ("depth", "view", "roll")] == [1, "left", 5]
    assert entry.settings["model"].value == str(Path("a.ply").absolute())
    assert entry.settings["view"].origin == "list.csv, line 2"


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"depth": "deep"}, "depth"),
        ({"detph": "1mm"}, "did you mean depth"),
        ({"depth": "20mm"}, "go through the stock"),
        ({"machine": "none"}, "no machine 'none'"),
    ],
)
def test_what_is_wrong_with_one_job_is_its_own_fault(values, told):
    bad, good = entries([job(**values), job("b.ply")], {}, {}, "relief")
    assert told in bad.fault
    assert not good.fault
    assert good.key


def test_what_is_wrong_with_all_is_refused():
    with pytest.raises(InputError, match="depth"):
        entries([job()], {"depth": "deep"}, {}, "relief")
    with pytest.raises(InputError, match="no setting"):
        entries([job()], {}, {"RELIEFFAB_DETPH": "1"}, "relief")
