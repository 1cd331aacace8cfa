import sys
from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.fittings import Edge, Frame, Hole, Keyhole
from relieffab.panel import cad
from relieffab.panel.cad import (
    CadUnavailableError,
    bent_solid,
    frame_solid,
    stock_solid,
    triangles,
    write_step,
)
from relieffab.round import Curved, Round
from relieffab.stock import Stock

pytest.importorskip("cadquery", exc_type=ImportError)
SLAB = Stock(120, 90, 8)
ARCH = 80 * 80 + pi * 40**2 / 2  # of 80 x 120 mm


def solid(stock):
    return stock_solid(stock, frame_solid(stock)).val()


@pytest.mark.parametrize(
    ("stock", "volume"),
    [
        (SLAB, 120 * 90 * 8),
        (replace(SLAB, corner=5.0), (120 * 90 - (4 - pi) * 25) * 8),
        (replace(SLAB, shape="round"), pi * 60 * 45 * 8),
        (Stock(80, 120, 8, shape="arched"), ARCH * 8),
        (Stock(80, 120, 8, shape="arched", corner=4.0), (ARCH - (4 - pi) * 8) * 8),
        (replace(SLAB, frame=Frame(10, 3)), 120 * 90 * 11 - 100 * 70 * 3),
        (replace(SLAB, frame=Frame(10, -3)), 120 * 90 * 5 + 100 * 70 * 3),
        # A chamfer's prisms along the field's sides, less what its corners have twice.
        (
            replace(SLAB, frame=Frame(10, -3, Edge("chamfer", 1))),
            120 * 90 * 5 + 100 * 70 * 3 - (340 * 0.5 - 4 / 3),
        ),
        (replace(SLAB, holes=(Hole((20, 20), 4),)), 120 * 90 * 8 - pi * 4 * 8),
        # A countersink is a cone's trunk, 2 mm high, instead of a cylinder.
        (
            replace(SLAB, holes=(Hole((20, 20), 4, 8),)),
            120 * 90 * 8 - pi * 4 * 6 - pi * 2 / 3 * (4 + 8 + 16),
        ),
    ],
)
def test_volumes_are_those_of_the_formula(stock, volume):
    made = solid(stock)
    assert made.isValid()
    assert made.Volume() == pytest.approx(volume, rel=1e-9)


HALF = 120 / 300 / 2  # of the angle a board of 120 mm takes of a circle of 300 mm
WIDE = 2 * 300 * np.sin(HALF)
BOARD = 300**2 / 2 * (2 * HALF - np.sin(2 * HALF)) + WIDE * (16 - 300 * (1 - np.cos(HALF)))


@pytest.mark.parametrize(
    ("stock", "volume", "low", "high"),
    [
        (Round(40, 30, 80), pi * 40**2 * 30, (-40, -40, 0), (40, 40, 30)),
        (Round(40, 30, 80, 60), pi * (40**2 - 30**2) * 30, (-40, -40, 0), (40, 40, 30)),
        (Round(40, 30, 80, 60, 5), pi * (40**2 * 30 - 30**2 * 25), (-40, -40, 0), (40, 40, 30)),
        (Curved(120, 30, 16, 300), BOARD * 30, (0, 0, -16), (WIDE, 30, 0)),
    ],
)
def test_round_stocks_read_back_with_the_volume_of_the_formula(tmp_path, stock, volume, low, high):
    import cadquery

    write_step(bent_solid(stock), tmp_path / "stock.step")
    read = cadquery.importers.importStep(str(tmp_path / "stock.step")).val()
    assert read.isValid()
    assert read.Volume() == pytest.approx(volume, rel=1e-9)
    box = read.BoundingBox()
    assert (box.xmin, box.ymin, box.zmin) == pytest.approx(low, abs=1e-6)
    assert (box.xmax, box.ymax, box.zmax) == pytest.approx(high, abs=1e-6)
    # A cup's floor is below.
    floor = np.array([box.zmin for box in map(_box, read.Faces()) if box.zmax == box.zmin])
    assert (5.0 in floor.round(6)) == (getattr(stock, "floor", 0) == 5)


def _box(shape):
    return shape.BoundingBox()


def test_a_keyhole_has_a_way_in_a_neck_and_room_for_the_head():
    key = Keyhole((60, 60), head=8, neck=4, travel=10, lip=2, cavity=3)
    made = solid(replace(SLAB, keyholes=(key,)))
    head = 8 * 10 + pi * 16
    # At the lip: the head's circle and, above it, what of the neck's slot is beyond it.
    reach = sqrt(16 - 4)  # where the neck's sides leave the circle
    segment = 16 * np.arcsin(2 / 4) - 2 * reach
    lip = pi * 16 + (10 - reach) * 4 + pi * 2 - segment
    assert SLAB.width * SLAB.height * 8 - made.Volume() == pytest.approx(3 * head + 2 * lip)
    assert made.BoundingBox().zmax == 0


def test_triangles_close_and_lie_within_a_hundredth_of_a_millimetre():
    stock = replace(SLAB, shape="round", frame=Frame(10, 3, Edge("fillet", 1)))
    stock = replace(stock, holes=(Hole((60, 20), 4, 8),), keyholes=())
    mesh = trimesh.Trimesh(*triangles(stock_solid(stock, frame_solid(stock))), process=False)
    assert mesh.is_volume
    assert mesh.bounds == pytest.approx(np.array([[0, 0, -8], [120, 90, 3]]), abs=0.01)
    side = np.hypot((mesh.vertices[:, 0] - 60) / 60, (mesh.vertices[:, 1] - 45) / 45)
    assert side.max() == pytest.approx(1, abs=1e-6)
    rim = mesh.vertices[(side > 1 - 1e-6) & (mesh.vertices[:, 2] < -7)][:, :2] - [60, 45]
    rim = rim[np.argsort(np.arctan2(rim[:, 1], rim[:, 0]))]
    chords = (rim + np.roll(rim, 1, axis=0)) / 2 / [60, 45]
    assert 60 * (1 - np.hypot(*chords.T)).max() < 0.0105
    assert mesh.volume == pytest.approx(solid(stock).Volume(), rel=1e-3)


def test_a_chamfer_that_crosses_itself_is_refused():
    stock = Stock(30, 40, 5.0, corner=5.0, frame=Frame(4.5, -2.0, Edge("chamfer", 1.0)))
    with pytest.raises(InputError, match=r"(?s)cannot give the frame that chamfer.*smaller"):
        cad.frame_solid(stock)


def test_a_fillet_that_the_kernel_cannot_make_is_refused(monkeypatch):
    from OCP.StdFail import StdFail_NotDone

    def fails(*_):
        raise StdFail_NotDone("BRep_API: command not done")

    monkeypatch.setattr(cad.cadquery().Workplane, "fillet", fails)
    with pytest.raises(InputError, match=r"(?s)cannot give the frame that fillet.*smaller"):
        frame_solid(replace(SLAB, frame=Frame(10, 3, Edge("fillet", 1))))


def test_step_reads_back_with_its_size(tmp_path, capfd):
    import cadquery

    write_step(stock_solid(SLAB), tmp_path / "stock.step")
    assert capfd.readouterr().out == ""
    read = cadquery.importers.importStep(str(tmp_path / "stock.step")).val()
    box = read.BoundingBox()
    low, high = (box.xmin, box.ymin, box.zmin), (box.xmax, box.ymax, box.zmax)
    assert low == pytest.approx((0, 0, -8), abs=1e-6)
    assert high == pytest.approx((120, 90, 0), abs=1e-6)
    assert read.Volume() == pytest.approx(120 * 90 * 8)
    with pytest.raises(InputError, match="cannot be written"):
        write_step(stock_solid(SLAB), tmp_path / "nowhere" / "stock.step")


class _Refusing:
    """An import hook that fails as a missing system library does."""

    def find_spec(self, name, path=None, target=None):
        if name == "cadquery":
            raise ImportError("libGL.so.1: cannot open shared object file")


def test_a_missing_system_library_is_named(monkeypatch):
    monkeypatch.delitem(sys.modules, "cadquery", raising=False)
    monkeypatch.setattr(sys, "meta_path", [_Refusing(), *sys.meta_path])
    with pytest.raises(CadUnavailableError, match=r"libGL\.so\.1") as caught:
        stock_solid(SLAB)
    assert "apt install libgl1 libx11-6" in str(caught.value)


def test_a_missing_package_is_named(monkeypatch):
    class Absent:
        def find_spec(self, name, path=None, target=None):
            if name == "cadquery":
                raise ModuleNotFoundError("No module named 'cadquery'", name="cadquery")

    monkeypatch.delitem(sys.modules, "cadquery", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Absent(), *sys.meta_path])
    with pytest.raises(CadUnavailableError, match="pip install cadquery"):
        stock_solid(SLAB)
