from dataclasses import fields

import pytest

from relieffab.errors import InputError
from relieffab.job.settings import Job, default_job, resolve
from relieffab.job.table import SETTINGS
from relieffab.layers.lines.drawing import Drawing


def test_the_job_has_a_field_for_every_setting():
    assert [f.name for f in fields(Job)] == [s.name for s in SETTINGS]


def test_defaults_make_a_job():
    job = default_job()
    assert job.size == (120.0, 90.0)
    assert job.depth == 3.0
    assert job.model is None


def test_the_first_source_wins_and_is_named():
    chosen = resolve([("flag", {"depth": "2mm"}), ("file", {"depth": "3mm", "size": "4x3in"})])
    assert (chosen["depth"].value, chosen["depth"].origin) == (2.0, "flag")
    assert (chosen["size"].value, chosen["size"].origin) == (pytest.approx((101.6, 76.2)), "file")
    assert chosen["margin"].origin == "default"


def test_unknown_keys_are_refused_with_a_suggestion_and_their_source():
    with pytest.raises(InputError, match=r"did you mean depth(.|\n)*") as caught:
        resolve([("job.toml", {"dept": "3mm"})])
    assert "job.toml" not in str(caught.value) or "where: job.toml" in str(caught.value)


@pytest.mark.parametrize("value", [True, [1, 2], {"a": 1}, "much", "-2mm", "0"])
def test_values_of_a_wrong_kind_name_their_setting(value):
    with pytest.raises(InputError, match="depth"):
        resolve([("job.toml", {"depth": value})])


def test_a_number_will_do_for_a_length():
    assert resolve([("job.toml", {"depth": 3})])["depth"].value == 3.0


def test_lines_are_drawn_alike_with_and_without_a_job():
    job, drawing = default_job(), Drawing()
    assert job.line_kinds == drawing.kinds
    assert (job.line_width, job.line_detail) == (drawing.width, drawing.detail)
    assert (job.line_length, job.line_spread) == (drawing.min_length, drawing.spread)


def test_kinds_of_line_are_words():
    assert default_job(line_kinds="ridge, outline").line_kinds == ("outline", "ridge")
