import sys

import pytest

from relieffab.errors import InputError
from relieffab.panel import stock as module
from relieffab.panel.stock import CadUnavailableError, finish_step, start_step, write_step
from relieffab.stock import Stock

SLAB = Stock(120, 90, 8)


def test_step_reads_back_with_its_size(tmp_path, capfd):
    cadquery = pytest.importorskip("cadquery", exc_type=ImportError)
    write_step(SLAB, tmp_path / "stock.step")
    assert capfd.readouterr().out == ""
    solid = cadquery.importers.importStep(str(tmp_path / "stock.step")).val()
    box = solid.BoundingBox()
    low, high = (box.xmin, box.ymin, box.zmin), (box.xmax, box.ymax, box.zmax)
    assert low == pytest.approx((0, 0, -8), abs=1e-6)
    assert high == pytest.approx((120, 90, 0), abs=1e-6)
    assert solid.Volume() == pytest.approx(120 * 90 * 8)
    with pytest.raises(InputError, match="cannot be written"):
        write_step(SLAB, tmp_path / "nowhere" / "stock.step")


class _Refusing:
    """An import hook that fails as a missing system library does."""

    def find_spec(self, name, path=None, target=None):
        if name == "cadquery":
            raise ImportError("libGL.so.1: cannot open shared object file")


def test_a_missing_system_library_is_named(tmp_path, monkeypatch):
    monkeypatch.delitem(sys.modules, "cadquery", raising=False)
    monkeypatch.setattr(sys, "meta_path", [_Refusing(), *sys.meta_path])
    with pytest.raises(CadUnavailableError, match=r"libGL\.so\.1") as caught:
        write_step(SLAB, tmp_path / "stock.step")
    assert "apt install libgl1 libx11-6" in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_package_is_named(tmp_path, monkeypatch):
    class Absent:
        def find_spec(self, name, path=None, target=None):
            if name == "cadquery":
                raise ModuleNotFoundError("No module named 'cadquery'", name="cadquery")

    monkeypatch.delitem(sys.modules, "cadquery", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Absent(), *sys.meta_path])
    with pytest.raises(CadUnavailableError, match="pip install cadquery"):
        write_step(SLAB, tmp_path / "stock.step")


def test_loading_the_module_does_not_load_cadquery():
    assert "cadquery" not in vars(module)


def test_another_process_writes_the_same_file(tmp_path):
    pytest.importorskip("cadquery", exc_type=ImportError)
    finish_step(start_step(SLAB, tmp_path / "stock.step"))
    assert "MANIFOLD_SOLID_BREP" in (tmp_path / "stock.step").read_text()


def test_what_another_process_could_not_do_is_told(tmp_path):
    process = start_step(SLAB, tmp_path / "nowhere" / "stock.step")
    with pytest.raises(CadUnavailableError, match="cannot be written"):
        finish_step(process)
