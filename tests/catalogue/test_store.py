import json

import pytest

from relieffab.catalogue.entries import Entry
from relieffab.catalogue.rows import waiting
from relieffab.catalogue.store import check_catalogue, summary, write
from relieffab.errors import InputError


def test_table_and_page_are_written_as_wholes(tmp_path):
    whole = summary(tmp_path, "make", [waiting(Entry("a", "a.ply"))], 0.5)
    write(whole, tmp_path)
    write(whole, tmp_path)
    assert json.loads((tmp_path / "batch.json").read_text()) == whole
    assert (whole["waiting"], whole["done"], whole["title"]) == (1, 0, tmp_path.name)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["batch.json", "index.html"]
    check_catalogue(tmp_path)


def test_jobs_of_other_lists_are_told(tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "report.json").touch()
    whole = summary(tmp_path, "make", [waiting(Entry("a", "a.ply"))], 0.5)
    assert whole["others"] == ["b"]


def test_a_folder_of_something_else_is_refused(tmp_path):
    check_catalogue(tmp_path / "new" / "deep")
    check_catalogue(tmp_path)
    (tmp_path / ".DS_Store").touch()
    check_catalogue(tmp_path)
    (tmp_path / "taxes").mkdir()
    with pytest.raises(InputError, match="no batch"):
        check_catalogue(tmp_path)
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="a file, not a folder"):
        check_catalogue(tmp_path / "file")
