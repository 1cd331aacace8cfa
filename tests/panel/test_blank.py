from dataclasses import replace

import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.fittings import Frame
from relieffab.panel import blank as module
from relieffab.panel.blank import drafting, make_blank, write_steps
from relieffab.panel.cad import CadUnavailableError
from relieffab.stock import Stock

SLAB = Stock(120, 90, 8)
FRAMED = replace(SLAB, frame=Frame(10, 2))


def box(blank):
    mesh = trimesh.Trimesh(blank.vertices, blank.faces, process=False)
    assert mesh.is_volume
    return mesh


def test_a_plain_slab_is_a_box_and_takes_no_cad_library(monkeypatch):
    monkeypatch.setattr(module.cad, "cadquery", lambda: pytest.fail("it was loaded"))
    mesh = box(make_blank(SLAB))
    assert mesh.volume == pytest.approx(120 * 90 * 8)
    assert mesh.bounds.tolist() == [[0, 0, -8], [120, 90, 0]]


def test_loading_the_module_does_not_load_cadquery():
    assert "cadquery" not in vars(module)


def test_another_process_writes_the_same(tmp_path):
    pytest.importorskip("cadquery", exc_type=ImportError)
    with drafting(FRAMED, tmp_path) as work:
        blank = work.blank()
        work.finish()
    assert box(blank).volume == pytest.approx(box(make_blank(FRAMED)).volume, rel=1e-12)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["frame.step", "stock.step"]
    assert "MANIFOLD_SOLID_BREP" in (tmp_path / "stock.step").read_text()


def test_a_plain_one_is_not_waited_for(tmp_path):
    with drafting(SLAB, tmp_path) as work:
        assert box(work.blank()).volume == pytest.approx(120 * 90 * 8)
    assert list(tmp_path.glob("*.npz")) == []


def test_what_another_process_could_not_do_is_told(tmp_path):
    with (
        drafting(SLAB, tmp_path / "nowhere") as work,
        pytest.raises(InputError, match="cannot be written"),
    ):
        work.finish()


def test_a_cad_library_that_is_not_there_is_told(tmp_path, monkeypatch):
    def missing(stock):
        raise CadUnavailableError("the stock cannot be drawn without cadquery")

    monkeypatch.setattr(module.cad, "frame_solid", missing)
    with pytest.raises(CadUnavailableError):
        write_steps(FRAMED, tmp_path)
    assert module._main(["Stock", '{"width": 9, "height": 9, "thickness": 3}', str(tmp_path)]) == 4
    assert module._main(["Stock", '{"width": 9, "height": 9, "thickness": 0}', str(tmp_path)]) == 2


def test_a_process_that_ends_by_itself_is_no_success(tmp_path):
    with drafting(SLAB, tmp_path) as work:
        work._process.kill()
        with pytest.raises(CadUnavailableError, match="exit status -9"):
            work.finish()
