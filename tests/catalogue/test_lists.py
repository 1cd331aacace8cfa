import pytest

from relieffab.catalogue.lists import read_list, wants_jobs
from relieffab.errors import InputError


def table(tmp_path, text, name="list.csv"):
    path = tmp_path / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


@pytest.mark.parametrize("mark", [",", ";", "\t"])
def test_a_table_as_spreadsheets_write_it(tmp_path, mark):
    rows = ["\ufeffModel;Name;line-depth;note", "a.ply;Amun;0.3mm;Inv. 17", ";;;", "sub/b.obj;;;"]
    one, two = read_list(table(tmp_path, "\r\n".join(rows).replace(";", mark)))
    assert (one.model, one.name, one.note) == (str(tmp_path / "a.ply"), "Amun", "Inv. 17")
    assert one.files[0][1] == {"line_depth": "0.3mm", "model": str(tmp_path / "a.ply")}
    assert two.model == str(tmp_path / "sub" / "b.obj")
    assert two.where.endswith("line 4")


def test_a_cell_that_holds_the_separator_wants_quotes(tmp_path):
    text = 'model,holes\na.ply,"5x5mm, 9x9mm"\nb.ply,5x5mm, 9x9mm\nc.ply,\n'
    good, bad, bare = read_list(table(tmp_path, text))
    assert good.files[0][1]["holes"] == "5x5mm, 9x9mm"
    assert "2 columns, 3 cells" in bad.fault
    assert "line 3" in bad.fault
    assert not bare.fault


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "which models"),
        ("file,depth\na.ply,3mm", "which models"),
        ("model,detph\na.ply,3mm", "did you mean depth"),
        (b"model,note\na.ply,Gr\xfcn", "CSV UTF-8"),
    ],
)
def test_a_list_that_cannot_be_read_is_refused(tmp_path, text, told):
    with pytest.raises(InputError, match=told):
        read_list(table(tmp_path, text))


def test_a_row_without_a_model_is_a_fault_of_its_own(tmp_path):
    bad, good = read_list(table(tmp_path, "model,depth\n,3mm\na.ply,2mm"))
    assert "names no model" in bad.fault
    assert good.model == str(tmp_path / "a.ply")


def test_lines_of_paths(tmp_path):
    text = "# scans\n\na.ply\n  b.obj  \n/abs/c.stl\n"
    jobs = read_list(table(tmp_path, text, "list.txt"))
    assert [job.model for job in jobs] == [
        str(tmp_path / "a.ply"),
        str(tmp_path / "b.obj"),
        "/abs/c.stl",
    ]


def test_jobs_in_toml_share_what_stands_before_them(tmp_path):
    text = """
    depth = "2mm"
    [[job]]
    model = "a.ply"
    view = "left"
    [[job]]
    model = "b.ply"
    depth = 1
    [[job]]
    """
    a, b, none = read_list(table(tmp_path, text, "list.toml"))
    assert [dict(values) for _, values in a.files] == [
        {"model": str(tmp_path / "a.ply"), "view": "left"},
        {"depth": "2mm"},
    ]
    assert b.files[0][1]["depth"] == 1
    assert "names no model" in none.fault


def test_what_all_jobs_share_is_read_at_once(tmp_path):
    with pytest.raises(InputError, match="no setting 'detph'"):
        read_list(table(tmp_path, 'detph = 2\n[[job]]\nmodel = "a.ply"', "list.toml"))
    with pytest.raises(InputError, match="not a list of jobs"):
        read_list(table(tmp_path, "job = 3", "list.toml"))


def test_a_job_file_is_a_job_and_may_stand_in_a_table(tmp_path):
    table(tmp_path, 'model = "m/a.ply"\ndepth = "2mm"', "amun.toml")
    (alone,) = read_list(tmp_path / "amun.toml")
    assert (alone.name, alone.model) == ("amun", str(tmp_path / "m" / "a.ply"))
    listed, missing = read_list(table(tmp_path, "model,depth\namun.toml,1mm\nno.toml,\n"))
    assert [values.get("depth") for _, values in listed.files] == ["1mm", "2mm"]
    assert listed.model == alone.model
    assert "no such job file" in missing.fault


def test_toml_about_something_else_asks_for_no_jobs(tmp_path):
    assert not wants_jobs(table(tmp_path, "[tool]\nx = 1", "other.toml"))
    assert wants_jobs(table(tmp_path, 'model = "a"', "job.toml"))
    assert wants_jobs(table(tmp_path, "= broken", "broken.toml"))


def test_files_that_a_row_names_are_looked_for_beside_the_list(tmp_path):
    (tmp_path / "list.csv").write_text("model,mask\nbust.png,figure.png\n")
    (job,) = read_list(tmp_path / "list.csv")
    (_, values), *_ = job.files
    assert values == {
        "model": str(tmp_path / "bust.png"),
        "mask": str(tmp_path / "figure.png"),
    }
