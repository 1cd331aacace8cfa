import json

import numpy as np
import pytest
import trimesh

from relieffab.cli.main import run
from relieffab.panel.plaque import raised
from relieffab.relief.model import pixel_slopes
from relieffab.relief.store import read_relief

SMALL = ["--size", "40x30mm", "--depth", "1.5mm", "--margin", "3mm", "--up", "z"]


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Two reliefs of one model at different resolutions."""
    home = tmp_path_factory.mktemp("compose")
    ball = trimesh.creation.icosphere(subdivisions=3)
    v = np.array(ball.vertices) * [3, 2, 1.5] * (1 + 0.05 * np.sin(5 * ball.vertices[:, :1]))
    trimesh.Trimesh(v, ball.faces, process=False).export(home / "ball.obj")
    for name, pixels in (("fine", "160x120"), ("coarse", "100x75")):
        more = ["--resolution", pixels, "-o", str(home / name)]
        assert run(["relief", str(home / "ball.obj"), *SMALL, *more]) == 0
    return home


def compose(home, out, *more):
    places = [f"{home / 'fine'}@5x5mm", f"{home / 'coarse'}@50x5mm"]
    return run(["compose", *places, "--size", "95x40mm", *more, "-o", str(out)])


def test_two_reliefs_become_one_panel_with_programs_and_template(folders, tmp_path, capsys):
    out = tmp_path / "both"
    holes = ["--holes", "2.5x2.5mm, 92.5x37.5mm", "--hole", "2mm", "--corner", "3mm"]
    assert compose(folders, out, *holes) == 0
    report = json.loads((out / "report.json").read_text())
    assert [part["place_mm"] for part in report["reliefs"]] == [[5, 5], [50, 5]]
    assert report["model"]["name"] == "ball.obj"
    assert report["settings"]["depth"] == "1.5mm"
    relief, fine = read_relief(out / "relief.tiff"), read_relief(folders / "fine" / "relief.tiff")
    assert relief.grid.pitch == fine.grid.pitch
    row, col = (round(v) for v in relief.grid.to_index(5 + fine.grid.origin[0], 35))
    shape = fine.heights.shape
    same = relief.heights[row : row + shape[0], col : col + shape[1]]
    np.testing.assert_allclose(same, fine.heights, atol=1e-6)
    assert run(["panel", str(out)]) == 0
    solid = trimesh.load_mesh(out / "panel.stl")
    assert solid.is_volume
    assert solid.bounds.tolist() == [[0, 0, -12], [95, 40, 0]]
    assert solid.euler_number == 2 - 2 * 2
    assert run(["toolpath", str(out)]) == 0
    assert run(["template", str(out)]) == 0
    assert "carves the relief" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("places", "more", "word"),
    [
        (["fine@5x5mm", "coarse@20x5mm"], [], "overlaps"),
        (["fine@5x5mm", "coarse@60x5mm"], [], "beyond the panel"),
        (["fine@5x5mm", "coarse@50x5mm"], ["--frame", "9mm"], "off the stock's face"),
        (["fine@5"], [], "FOLDER@XxY"),
        (["fine"], [], "FOLDER@XxY"),
        (["nowhere@5x5mm"], [], "holds no job"),
        ([], [], "no relief to lay out"),
    ],
)
def test_what_cannot_be_laid_out_is_refused(folders, tmp_path, capsys, places, more, word):
    given = [str(folders / place) for place in places]
    out = tmp_path / "none"
    assert run(["compose", *given, "--size", "95x40mm", *more, "-o", str(out)]) == 2
    assert word in capsys.readouterr().err
    assert not out.exists()


def test_each_keeps_its_own_walls(folders, tmp_path):
    slanted, both, again = (tmp_path / name for name in ("slanted", "both", "again"))
    more = ["--resolution", "100x75", "--wall-angle", "45deg", "-o", str(slanted)]
    assert run(["relief", str(folders / "ball.obj"), *SMALL, *more]) == 0
    given = [f"{folders / 'fine'}@5x5mm", f"{slanted}@50x5mm"]
    assert run(["compose", *given, "--size", "95x40mm", "-o", str(both)]) == 0
    report = json.loads((both / "report.json").read_text())
    assert [part["wall_angle_deg"] for part in report["reliefs"]] == [80, 45]
    assert report["settings"]["wall_angle"] == "80deg"  # the steepest stands for all
    walls, relief = read_relief(both / "walls.tiff"), read_relief(both / "relief.tiff")
    assert (relief.heights >= walls.heights - 1e-5).all()
    slopes = np.degrees(np.arctan(np.hypot(*pixel_slopes(walls.heights, walls.grid.pitch))))
    left, right = slopes[:, : walls.grid.cols // 2], slopes[:, walls.grid.cols // 2 :]
    assert np.median(left[left > 0]) == pytest.approx(80, abs=1)
    assert np.median(right[right > 0]) == pytest.approx(45, abs=2)
    # A panel that is composed already is laid out as any other, with all its walls.
    assert run(["compose", f"{both}@0x0mm", "--size", "95x40mm", "-o", str(again)]) == 0
    np.testing.assert_array_equal(read_relief(again / "walls.tiff").heights, walls.heights)
    assert run(["panel", str(both), "--solid", "plaque"]) == 0
    plaque = trimesh.load_mesh(both / "plaque.stl")
    wanted = raised(relief, walls.heights)
    assert plaque.is_volume
    # One angle for both would take the slanted wall for the figure's own form.
    assert np.abs(wanted.heights - raised(relief, 80.0).heights).max() > 0.3
    height = (wanted.heights + relief.depth)[1:, 1:].sum() * relief.grid.pitch**2
    assert plaque.volume == pytest.approx(95 * 40 * 12 + height, rel=1e-3)


def test_a_frieze_goes_round_a_column_through_its_seam(folders, tmp_path):
    out = tmp_path / "frieze"
    coarse = folders / "coarse"
    places = [f"{coarse}@25x1mm", f"{coarse}@67x1mm"]
    column = ["--round", "27mm", "--size", "84.82x32mm", "-o", str(out)]
    assert run(["compose", *places, *column]) == 0
    relief = read_relief(out / "relief.tiff")
    assert relief.grid.cols * relief.grid.pitch == pytest.approx(27 * np.pi, abs=1e-7)
    assert relief.mask[:, 0].any() and relief.mask[:, -1].any()
    assert run(["panel", str(out)]) == 0
    solid = trimesh.load_mesh(out / "panel.stl")
    assert solid.is_volume and solid.euler_number == 2
