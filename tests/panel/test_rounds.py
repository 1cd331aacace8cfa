from math import pi

import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.panel.rounds import facing, make_round
from relieffab.panel.weld import weld
from relieffab.relief.model import Relief
from relieffab.round import Curved, Round

R = 40.0


def flat_relief(cols=40, rows=10):
    grid = Grid(rows, cols, 1.0, (0.0, float(rows)))
    return Relief(grid, np.zeros((rows + 1, cols + 1)), np.ones((rows, cols), bool), 1.0)


def all_round(heights):
    """A relief whose columns go once round a face of radius R, square pixels."""
    heights = np.asarray(heights, float)
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    pitch = 2 * pi * R / cols
    grid = Grid(rows, cols, pitch, (0.0, rows * pitch))
    return Relief(grid, heights, np.ones((rows, cols), bool), 2.0), grid


def assert_sound(solid):
    mesh = trimesh.Trimesh(solid.vertices, solid.faces, process=False)
    assert solid.watertight and mesh.is_volume
    assert mesh.volume == pytest.approx(solid.volume_mm3)
    welded = trimesh.Trimesh(*weld(solid.vertices, solid.faces), process=False)
    assert welded.is_watertight


@pytest.mark.parametrize(
    ("stock", "volume"),
    [
        (Round(40, 30, 80), pi * 40**2 * 30),
        (Round(40, 30, 80, 60), pi * (40**2 - 30**2) * 30),
        (Round(40, 30, 80, 60, 5), pi * (40**2 * 30 - 30**2 * 25)),
    ],
)
def test_bare_column_ring_and_cup(stock, volume):
    solid = make_round(flat_relief(), stock, tolerance=0.01)
    assert_sound(solid)
    assert solid.volume_mm3 == pytest.approx(volume, rel=3e-4)
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    np.testing.assert_allclose([low[2], high[2]], [0, 30], atol=1e-9)
    assert np.hypot(*solid.vertices[:, :2].T).max() == pytest.approx(40)


def test_a_bare_board():
    stock = Curved(120, 30, 16, 300)
    solid = make_round(flat_relief(), stock, tolerance=0.01)
    assert_sound(solid)
    half = 120 / 300 / 2
    segment = 300**2 / 2 * (2 * half - np.sin(2 * half))
    width = 2 * 300 * np.sin(half)
    exact = (segment + width * (16 - 300 * (1 - np.cos(half)))) * 30
    assert solid.volume_mm3 == pytest.approx(exact, rel=1e-4)
    assert solid.vertices.max(axis=0).tolist() == pytest.approx([width, 30, 0], abs=0.003)


def test_a_band_all_round_takes_the_volume_of_the_formula():
    h = np.zeros((21, 252))
    h[5:16] = -1.5
    relief, grid = all_round(h)
    stock = Round(2 * pi * R, grid.rows * grid.pitch, 80, 60)
    solid = make_round(relief, stock, tolerance=0.01)
    assert_sound(solid)
    assert solid.max_error_mm <= 0.01
    d, p = 1.5, grid.pitch
    level, ramps = (R * d - d * d / 2) * 10 * p, 2 * (R * d / 2 - d * d / 6) * p
    bare = make_round(Relief(grid, 0 * h, relief.mask, 2.0), stock, tolerance=0.01)
    removed = bare.volume_mm3 - solid.volume_mm3
    assert removed == pytest.approx(2 * pi * (level + ramps), rel=2e-3)


def test_a_frieze_joins_at_its_seam():
    y, x = np.mgrid[0:31, 0:201]
    h = -1 - 0.6 * np.sin(2 * pi * x / 200 * 7 + 1.0) * np.cos(y / 5)
    h[:3] = h[-3:] = 0
    relief, grid = all_round(h)
    solid = make_round(relief, Round(2 * pi * R, grid.rows * grid.pitch, 80))
    assert_sound(solid)
    assert solid.max_error_mm <= 0.02
    # Turned by half a turn the same frieze has its seam elsewhere, and is the same solid.
    rolled = np.roll(h[:, :-1], 100, axis=1)
    turned = Relief(grid, np.c_[rolled, rolled[:, :1]], relief.mask, 2.0)
    other = make_round(turned, Round(2 * pi * R, grid.rows * grid.pitch, 80))
    assert solid.volume_mm3 == pytest.approx(other.volume_mm3, rel=2e-5)


def test_a_frieze_that_does_not_join_is_refused():
    h = np.full((11, 201), -1.0)
    h[:, -1] = -0.5
    relief, grid = all_round(h)
    with pytest.raises(InputError, match="does not join"):
        make_round(relief, Round(2 * pi * R, grid.rows * grid.pitch, 80))


def test_a_cut_up_to_the_panels_edge_ends_in_a_wall(make_relief):
    relief = make_relief(np.full((11, 41), -1.5), rim=0.0)
    stock = Round(40, 10, 80)
    solid = make_round(relief, stock, tolerance=0.01)
    assert_sound(solid)
    removed = (R**2 - (R - 1.5) ** 2) / 2 * (40 / R) * 10
    assert pi * R**2 * 10 - solid.volume_mm3 == pytest.approx(removed, rel=0.02)


@pytest.mark.parametrize("stock", [Round(26, 20, 20), Round(26, 20, 60, 50), Curved(26, 20, 8, 60)])
def test_bumps_on_every_stock_keep_the_tolerance(bumpy, stock):
    solid = make_round(bumpy, stock, tolerance=0.01)
    assert_sound(solid)
    assert 0 < solid.max_error_mm <= 0.01
    # Points of its triangles, unwrapped, lie on the relief.
    lying = facing(solid, stock).vertices
    if isinstance(stock, Curved):
        lying = lying - [stock.radius * np.sin(13 / stock.radius), 0, -stock.radius]
    corners = lying[solid.faces]
    rng = np.random.default_rng(1)
    points = np.einsum("fc,fcx->fx", rng.dirichlet([1, 1, 1], len(corners)), corners)
    x, y, h = stock.bend.flat(points).T
    out = np.einsum(
        "fx,fx->f", np.cross(*np.diff(corners, axis=1).swapaxes(0, 1)), points * [1, 0, 1]
    )
    seen = (h > -3) & (out > 1e-3) & (x > 0.01) & (x < 25.99) & (y > 0.01) & (y < 19.99)
    assert seen.sum() > 3000
    x, y, h = x[seen], y[seen], h[seen]
    want = bumpy.height_at(x, y)
    step = 1e-4
    gx, gy = (bumpy.height_at(x + i * step, y + j * step) - want for i, j in ((1, 0), (0, 1)))
    assert (np.abs(h - want) <= 0.0101 * np.hypot(1, np.hypot(gx, gy) / step)).all()


def test_the_middle_of_the_panel_faces_front(bumpy):
    solid = make_round(bumpy, Round(26, 20, 60))
    lowest = solid.vertices[np.hypot(*solid.vertices[:, :2].T) < 28.5]
    assert (lowest[:, 1] < 0).all()
    # What is on the panel's right is on the right for who looks from the front.
    bent = facing(solid, Round(26, 20, 60))
    assert bent.vertices[:, 2].max() == pytest.approx(30, abs=0.01)


def test_bad_input(bumpy):
    with pytest.raises(InputError, match="through the stock"):
        make_round(bumpy, Round(26, 20, 60, 58))
    with pytest.raises(InputError, match="tolerance cannot be met"):
        make_round(bumpy, Round(26, 20, 60), tolerance=0)
    with pytest.raises(InputError, match="reaches beyond"):
        make_round(bumpy, Round(26, 15, 60))
