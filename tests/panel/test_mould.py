from math import radians, tan

import manifold3d
import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.raster import rasterise
from relieffab.panel.carve import make_panel
from relieffab.panel.model import Panel
from relieffab.panel.mould import FLOOR, RIM, leaning, make_mould, outer_size
from relieffab.panel.solid import manifold_of
from relieffab.panel.weld import weld
from relieffab.stock import Stock

STOCK = Stock(26, 20, 6)


@pytest.fixture
def panel(bumpy):
    return make_panel(bumpy, STOCK, tolerance=0.01)


def frustum(draft):
    """Volume of the slab with sides that lean."""
    s, t, w, h = tan(radians(draft)), 6.0, 26.0, 20.0
    return w * h * t + (w + h) * s * t**2 + 4 / 3 * s**2 * t**3


@pytest.mark.parametrize("draft", [0.0, 3.0, 20.0])
def test_the_cavity_is_the_panel_and_what_its_sides_lean(panel, draft):
    mould = make_mould(panel, draft)
    outer = np.prod([*outer_size((26.0, 20.0), 6.0, draft), 6.0 + FLOOR])
    cast = panel.volume_mm3 + frustum(draft) - frustum(0.0)
    assert outer - mould.volume_mm3 == pytest.approx(cast, rel=1e-9)
    low, high = mould.vertices.min(axis=0), mould.vertices.max(axis=0)
    assert low == pytest.approx([0, 0, -FLOOR])
    assert high == pytest.approx([*outer_size((26.0, 20.0), 6.0, draft), 6.0])


def test_it_is_a_solid_to_files_too(panel):
    mould = make_mould(panel)
    assert mould.watertight
    for mesh in ((mould.vertices, mould.faces), weld(mould.vertices, mould.faces)):
        solid = trimesh.Trimesh(*mesh, process=False)
        assert solid.is_volume
        assert solid.volume == pytest.approx(mould.volume_mm3, rel=1e-5)


def test_bumps_stand_where_the_panel_is_sunk_and_mirrored(panel, bumpy):
    mould = make_mould(panel)
    assert mould.max_error_mm == panel.max_error_mm <= 0.01
    around = RIM + 6.0 * tan(radians(3.0))
    # Turned about Y the relief's columns run from right to left.
    rows, cols = bumpy.grid.shape
    x, y = bumpy.grid.origin
    left = around + 26.0 - (x + cols * bumpy.grid.pitch)
    grid = Grid(rows - 1, cols - 1, 0.25, (left + 0.125, around + y - 0.125))
    floor = rasterise(mould.vertices, mould.faces, grid).depth
    assert np.abs(floor + bumpy.heights[1:-1, -2:0:-1]).max() <= 0.01


def test_the_cast_lies_in_it_face_down(panel):
    mould = make_mould(panel, 5.0)
    cast = Panel(leaning(panel, 5.0), panel.faces, True, 0.0, 0.0)
    around = RIM + 6.0 * tan(radians(5.0))
    turned = manifold_of(cast.vertices, cast.faces, "the cast").rotate((0.0, 180.0, 0.0))
    turned = turned.translate((26.0 + around, around, 0.0))
    assert (
        turned ^ manifold_of(mould.vertices, mould.faces, "the mould")
    ).volume() == pytest.approx(0, abs=1e-6)
    # It comes out upwards and does not go down.
    for step, free in ((0.5, True), (-0.5, False)):
        moved = turned.translate((0.0, 0.0, step)) ^ manifold_of(
            mould.vertices, mould.faces, "the mould"
        )
        assert (moved.volume() < 1e-6) == free


@pytest.mark.parametrize("draft", [-1.0, 46.0, float("nan")])
def test_a_draft_that_no_wall_has_is_refused(panel, draft):
    with pytest.raises(InputError, match="draft"):
        make_mould(panel, draft)


def test_a_round_panel_is_refused():
    disc = manifold3d.Manifold.cylinder(4.0, 10.0).translate((0.0, 0.0, -4.0)).to_mesh64()
    faces = np.array(disc.tri_verts, np.int64)
    with pytest.raises(InputError, match="only a rectangular panel"):
        make_mould(Panel(np.array(disc.vert_properties), faces, True, 1.0, 0.0))
