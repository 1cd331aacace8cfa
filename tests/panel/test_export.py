import re
import shutil
import subprocess

import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.panel import export
from relieffab.panel.carve import make_panel
from relieffab.panel.export import write_3mf, write_panel, write_stl
from relieffab.panel.formats import FORMATS
from relieffab.panel.model import Panel
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


def test_glb_is_in_metres_with_y_up(panel, tmp_path):
    write_panel(panel, tmp_path / "panel.glb", name="Käfer")
    scene = trimesh.load_scene(tmp_path / "panel.glb")
    assert list(scene.geometry) == ["Käfer"]
    mesh = scene.to_mesh()
    # The face, Z0 of the panel, looks along +Y; what was far is at -Z.
    assert mesh.bounds == pytest.approx(np.array([[0, -0.006, -0.020], [0.026, 0, 0]]))
    x, y, z = 1000 * mesh.vertices.T
    assert_same(trimesh.Trimesh(np.stack([x, -z, y], axis=1), mesh.faces), panel)


@pytest.mark.parametrize("kind", FORMATS)
def test_the_same_panel_gives_the_same_bytes(panel, tmp_path, kind):
    one, other = tmp_path / f"a.{kind}", tmp_path / f"b.{kind}"
    for path in (one, other):
        write_panel(panel, path, name="panel", picture=b"a picture")
    assert one.read_bytes() == other.read_bytes()


@pytest.mark.parametrize("suffix", [".stl", ".3mf", ".ply", ".obj", ".STL"])
def test_the_suffix_names_the_format(panel, tmp_path, suffix):
    path = tmp_path / f"panel{suffix}"
    write_panel(panel, path)
    assert_same(trimesh.load_scene(path).to_mesh(), panel)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("kind", [kind for kind in FORMATS if kind != "glb"])
def test_every_format_in_mm_holds_the_same_positions(panel, tmp_path, kind):
    write_panel(panel, tmp_path / f"panel.{kind}")
    back = trimesh.load_scene(tmp_path / f"panel.{kind}").to_mesh()
    want = np.unique(panel.vertices.astype(np.float32), axis=0)
    np.testing.assert_array_equal(np.unique(back.vertices.astype(np.float32), axis=0), want)


def judged_by_admesh(path):
    told = subprocess.run(["admesh", str(path)], capture_output=True, text=True, check=True).stdout
    counts = dict(re.findall(r"^([A-Z][a-z 0-9]+?) +: +(\d+)\b", told, re.MULTILINE))
    faults = ("Total disconnected facets", "Degenerate facets", "Edges fixed", "Backwards edges")
    volume = float(re.search(r"Volume +: +([\d.]+)", told)[1])
    return int(counts["Number of facets"]), volume, [int(counts[fault]) for fault in faults]


@pytest.mark.skipif(not shutil.which("admesh"), reason="admesh is not installed; .ci/run does")
def test_admesh_finds_nothing_to_mend_but_does_find_a_hole(panel, tmp_path):
    path = tmp_path / "panel.stl"
    write_stl(panel, path)
    facets, volume, faults = judged_by_admesh(path)
    assert (facets, faults) == (len(panel.faces), [0, 0, 0, 0])
    assert volume == pytest.approx(panel.volume_mm3, rel=1e-5)
    write_stl(Panel(panel.vertices, panel.faces[:-1], False, 0.0, 0.0), path)
    assert judged_by_admesh(path)[2][0] == 3


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
