import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.job.report import read_report, start_report, write_report
from relieffab.job.settings import resolve
from relieffab.picture import png8


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


def test_the_page_shows_pictures_of_earlier_stages(tmp_path):
    report = start_report(resolve([]))
    report["model"] = {"name": "horse", "notes": []}
    report["picture"] = {"file": "preview.png", "method": "hillshade"}
    kept, new = tmp_path / "kept", tmp_path / "new"
    for folder in (kept, new):
        folder.mkdir()
    (kept / "preview.png").write_bytes(png8(np.zeros((4, 4), np.uint8)))
    write_report(report, new)
    assert "data:image" not in (new / "report.html").read_text()
    write_report(report, new, kept=kept)
    assert "data:image" in (new / "report.html").read_text()
