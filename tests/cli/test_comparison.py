import json

import pytest
import trimesh

from relieffab.cli.comparison import COLUMNS, table
from relieffab.cli.main import run
from relieffab.relief.names import NAMES

SMALL = ["--size", "40x30mm", "--resolution", "96x72", "--margin", "3mm", "--depths", "5,10%"]


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "ball.obj"
    ball = trimesh.creation.icosphere(subdivisions=3)
    ball.apply_scale([3, 2, 1.5])
    ball.export(path)
    return path


def test_all_methods_are_printed_and_laid_out(model, tmp_path, capsys):
    folder = tmp_path / "out"
    assert run(["compare", str(model), *SMALL, "-o", str(folder)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines if line.startswith(NAMES)] == [*NAMES, *NAMES]
    widths = {len(line) for line in lines if line.startswith(NAMES)}
    assert len(widths) == 1
    assert sorted(p.name for p in folder.iterdir()) == ["compare.json", "compare.png"]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out"]
    assert run(["compare", str(model), *SMALL, "-o", str(folder)]) == 2
    assert "--overwrite" in capsys.readouterr().err


def test_json_is_the_whole_table(model, capsys):
    assert run(["compare", str(model), *SMALL, "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert [r["method"] for r in report["reliefs"]] == [*NAMES, *NAMES]
    assert len(table(report["reliefs"]).splitlines()) == 2 + 2 * (1 + len(NAMES))


def test_a_figure_without_meaning_is_a_dash():
    quality = {}
    for _, _, measure, names in COLUMNS:
        for name in [names] if isinstance(names, str) else names:
            quality.setdefault(measure, {})[name] = None
    row = {"method": "linear", "depth_mm": 1.0, "quality": quality}
    assert table([row]).splitlines()[-1].split() == ["linear", "1.00", *["-"] * len(COLUMNS)]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--depths", "0"], "percentages"),
        (["--depths", "5,5"], "percentages"),
        (["--depths", "5,,10"], "percentages"),
        (["--depths", "nan"], "percentages"),
        (["--wall-angle", "95"], "wall"),
        (["--lines", "ball-11"], "ball-1"),
        (["--method", "linear"], ""),
    ],
)
def test_what_makes_no_sense_leaves_nothing(model, tmp_path, capsys, arguments, words):
    flags = ["--resolution", "96x72", *arguments]
    assert run(["compare", str(model), *flags, "-o", str(tmp_path / "out")]) == 2
    assert words in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_model_that_is_not_there(tmp_path, capsys):
    assert run(["compare", str(tmp_path / "none.stl"), "-o", str(tmp_path / "out")]) == 2
    assert list(tmp_path.iterdir()) == []
