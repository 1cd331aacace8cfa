import pytest

from relieffab.errors import InputError
from relieffab.job.report import read_report, start_report, write_report
from relieffab.job.settings import resolve


def test_a_report_comes_back_as_it_was_written(tmp_path):
    report = start_report(resolve([("flag", {"depth": "2mm"})]))
    report["model"] = {"name": "<b>horse</b>", "notes": ["inside out & turned"]}
    write_report(report, tmp_path)
    back = read_report(tmp_path)
    assert back["settings"]["depth"] == "2mm"
    assert list(back)[:3] == ["schema", "version", "model"]


def test_a_number_that_is_none_is_never_written(tmp_path):
    report = start_report(resolve([]))
    report["model"] = {"name": float("nan")}
    with pytest.raises(ValueError, match="Out of range"):
        write_report(report, tmp_path)


@pytest.mark.parametrize(
    ("text", "words"),
    [("", "cannot be read"), ("[1]", "another schema"), ('{"schema": 2}', "another schema")],
)
def test_reports_of_others_are_refused(tmp_path, text, words):
    (tmp_path / "report.json").write_text(text)
    with pytest.raises(InputError, match=words):
        read_report(tmp_path)
