import io
import tomllib

import pytest

from relieffab import profiles
from relieffab.cli.main import run
from relieffab.grbl.simulator.settings import Settings


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(profiles, "user_folder", lambda: tmp_path / "profiles")
    return tmp_path / "profiles" / "machines"


@pytest.fixture
def dump(tmp_path):
    path = tmp_path / "dump.txt"
    path.write_text("[OPT:V,15,128]\r\n" + "\r\n".join(Settings().lines()) + "\r\nok\r\n")
    return path


def test_a_dump_becomes_a_machine_that_can_be_asked_for(folder, dump, capsys):
    assert run(["machines", "import-grbl", str(dump), "--name", "mine", "--title", "Mine"]) == 0
    assert capsys.readouterr().out.split() == ["mine", "Mine"]
    assert profiles.machine("mine").travel == (263, 157, 34)
    assert run(["machines"]) == 0
    assert "mine" in capsys.readouterr().out


def test_a_dump_may_be_piped_in(folder, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO("\n".join(Settings({30: 1000}).lines())))
    assert run(["machines", "import-grbl", "-", "--name", "mine"]) == 0
    assert tomllib.loads((folder / "mine.toml").read_text())["spindle_max_setting"] == 1000


def test_a_profile_is_not_overwritten_unless_told(folder, dump, capsys):
    for expected, more in ((0, []), (2, []), (0, ["--overwrite"])):
        assert run(["machines", "import-grbl", str(dump), "--name", "mine", *more]) == expected


@pytest.mark.parametrize(
    ("text", "name", "why"),
    [("$0=10", "mine", "not a whole dump"), ("", "../x", "cannot be the name")],
)
def test_bad_input_leaves_nothing(folder, dump, text, name, why, capsys):
    dump.write_text(text)
    assert run(["machines", "import-grbl", str(dump), "--name", name]) == 2
    assert why in capsys.readouterr().err
    assert not folder.exists()


def test_a_dump_that_is_not_there(folder, capsys):
    assert run(["machines", "import-grbl", "no.txt", "--name", "mine"]) == 2
