import zipfile

import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.panel import export
from relieffab.panel.carve import make_panel
from relieffab.panel.export import write_3mf, write_panel, write_stl
from relieffab.stock import Stock


@pytest.fixture
def panel(bumpy):
    return make_panel(bumpy, Stock(26, 20, 6))


def assert_same(mesh, panel):
    assert mesh.is_watertight
    assert len(mesh.faces) == len(panel.faces)
    assert mesh.volume == pytest.approx(panel.volume_mm3, rel=1e-6)
    assert mesh.bounds == pytest.approx(np.array([[0, 0, -6], [26, 20, 0]]))


def test_stl_reads_back(panel, tmp_path):
    write_stl(panel, tmp_path / "panel.stl")
    assert (tmp_path / "panel.stl").stat().st_size == 84 + 50 * len(panel.faces)
    assert_same(trimesh.load_mesh(tmp_path / "panel.stl"), panel)


def test_3mf_reads_back_in_millimetres_with_its_name(panel, tmp_path):
    write_3mf(panel, tmp_path / "panel.3mf", name='a "cow" & <calf>')
    scene = trimesh.load_scene(tmp_path / "panel.3mf")
    assert scene.units == "millimeter"
    assert list(scene.geometry) == ['a "cow" & <calf>']
    assert_same(scene.to_mesh(), panel)


def test_the_same_panel_gives_the_same_bytes(panel, tmp_path):
    for name in ("a.3mf", "b.3mf"):
        write_3mf(panel, tmp_path / name, name="panel")
    assert (tmp_path / "a.3mf").read_bytes() == (tmp_path / "b.3mf").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.3mf") as package:
        assert package.namelist()[0] == "[Content_Types].xml"


@pytest.mark.parametrize("suffix", [".stl", ".3mf", ".ply", ".obj", ".STL"])
def test_the_suffix_names_the_format(panel, tmp_path, suffix):
    path = tmp_path / f"panel{suffix}"
    write_panel(panel, path)
    assert_same(trimesh.load_scene(path).to_mesh(), panel)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_an_unknown_suffix_is_refused(panel, tmp_path):
    with pytest.raises(InputError, match=r"did you mean \.stl"):
        write_panel(panel, tmp_path / "panel.slt")
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_refused(panel, tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        write_stl(panel, tmp_path / "nowhere" / "panel.stl")


def test_a_fault_halfway_leaves_the_old_file_alone(panel, tmp_path):
    path = tmp_path / "panel.stl"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), export.beside(path) as part:
        part.write_text("half")
        raise ZeroDivisionError
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
