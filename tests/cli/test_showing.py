import json

import pytest
from PIL import Image

from relieffab.cli import showing
from relieffab.cli.main import run
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.relief.store import to_tiff


@pytest.fixture
def relief(tmp_path):
    import numpy as np

    grid = Grid.on_panel((12.0, 9.0), (64, 48))
    heights = np.zeros(grid.node_shape)
    heights[10:30, 20:40] = -1.0
    path = tmp_path / "relief.tiff"
    path.write_bytes(to_tiff(Relief(grid, heights, np.ones(grid.shape, bool), 1.0)))
    return path


def test_a_picture_is_written_and_the_facts_are_told(relief, tmp_path, capsys):
    picture = tmp_path / "seen.png"
    assert run(["show", str(relief), "-o", str(picture), "--light", "45,30"]) == 0
    assert Image.open(picture).size == (64, 48)
    out = capsys.readouterr().out.splitlines()
    assert out[1].split() == ["size", "12", "x", "9", "mm"]
    assert out[-1].endswith(str(picture))


def test_without_a_screen_it_says_where_the_picture_is(relief, capsys, monkeypatch):
    opened = []
    monkeypatch.setattr(showing.webbrowser, "open", opened.append)
    monkeypatch.setattr(showing, "_screen", lambda: False)
    assert run(["show", str(relief), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["kind"], told["deepest_mm"]) == ("relief", 1.0)
    assert Image.open(told["shown"]).size == (64, 48)
    monkeypatch.setattr(showing, "_screen", lambda: True)
    assert run(["show", str(relief)]) == 0
    assert len(opened) == 1
    assert opened[0].startswith("file:///")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["-o", "picture.jpg"], "written as PNG"),
        (["-o", "no/such/folder/picture.png"], "cannot be written there"),
        (["--light", "45"], "two angles"),
        (["--light", "45,0"], "does not stand above"),
        (["--texture", "brass"], "stone"),
    ],
)
def test_what_cannot_be_is_refused(relief, words, told, capsys):
    assert run(["show", str(relief), *words]) == 2
    assert told in capsys.readouterr().err


def test_a_page_is_no_picture(tmp_path, capsys):
    page = tmp_path / "report.html"
    page.write_text("<html></html>")
    assert run(["show", str(page), "-o", str(tmp_path / "a.png")]) == 2
    assert "no picture to write" in capsys.readouterr().err
    assert run(["show", str(page)]) == 0
    assert str(page) in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("seconds", 5025, "1 h 24 min"),
        ("bounds_mm", [[0, 0, -1], [2, 3, 4]], "X 0 to 2, Y 0 to 3, Z -1 to 4 mm"),
        ("work_zero_mm", [0, 0, -12], "X 0, Y 0, Z -12 mm"),
        ("figure_share", 0.25, "25.0%"),
        ("triangles", 12000, "12,000"),
        ("carves_the_relief", True, "yes"),
        ("cutters", ["a", "b"], "a, b"),
    ],
)
def test_facts_in_words(name, value, text):
    assert showing._words(name, value) == text
