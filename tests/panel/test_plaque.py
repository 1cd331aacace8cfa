import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.raster import rasterise
from relieffab.panel.plaque import freed, make_plaque, raised
from relieffab.panel.weld import weld
from relieffab.relief.edge import inward_distance, wall
from relieffab.relief.model import Relief, nodes_of
from relieffab.stock import Stock

DEPTH, PITCH = 3.0, 0.25


def domed():
    """A gentle dome, and a bar narrower than its walls, with the wall around both."""
    rows, cols = 96, 128
    y, x = np.mgrid[0 : rows + 1, 0 : cols + 1] * PITCH
    dome = -1.0 - 0.01 * ((x - 14) ** 2 + (y - 12) ** 2)
    inside = (np.hypot(x - 14, y - 12) < 9) | ((abs(x - 28.5) < 0.6) & (abs(y - 12) < 8))
    mask = inside[1:, 1:]
    edge = wall(mask, PITCH, 80.0, DEPTH)
    heights = np.where(nodes_of(mask), np.maximum(dome, edge), 0.0)
    return Relief(Grid(rows, cols, PITCH, (0.1, rows * PITCH + 0.9)), heights, mask, DEPTH), dome


@pytest.fixture(scope="module")
def plaque():
    relief, _ = domed()
    return make_plaque(relief, Stock(33.0, 25.0, 5.0), tolerance=0.01)


def test_the_figure_goes_on_where_the_wall_stood():
    relief, dome = domed()
    found = freed(relief, 80.0)
    disc = nodes_of(relief.mask)
    disc[:, 104:] = False
    assert np.abs(found - dome)[disc].max() < 0.25
    unmoved = disc & (inward_distance(relief.mask) > 5)
    assert unmoved.sum() > 2000
    assert (found[unmoved] == dome[unmoved]).all()
    # The bar, a trench without a floor, is as deep as it was.
    bar = nodes_of(relief.mask) & ~disc
    assert found[bar].min() == pytest.approx(relief.heights[bar].min(), abs=0.05)
    assert found[bar].max() < 0.9 * relief.heights[bar].min()


def test_it_stands_out_of_a_level_ground():
    relief, _ = domed()
    found = raised(relief)
    figure = nodes_of(relief.mask)
    assert (found.heights[~figure] == -DEPTH).all()
    at_edge = figure & (inward_distance(relief.mask) <= 0)
    assert at_edge.any()
    assert found.heights[at_edge] == pytest.approx(-DEPTH)
    inner = inward_distance(relief.mask) > 5
    assert (found.heights[inner] == relief.heights[inner]).all()


def test_the_solid_is_within_tolerance_and_covers_the_whole_stock(plaque):
    relief, _ = domed()
    heights, grid = raised(relief).heights, relief.grid
    assert plaque.max_error_mm <= 0.01
    nodes = Grid(grid.rows - 1, grid.cols - 1, PITCH, grid.to_xy(0.5, 0.5))
    seen = rasterise(plaque.vertices, plaque.faces, nodes).depth
    assert np.abs(seen - heights[1:-1, 1:-1]).max() <= 0.01
    low, high = plaque.vertices.min(axis=0), plaque.vertices.max(axis=0)
    assert low == pytest.approx([0, 0, -8])
    assert high == pytest.approx([33, 25, heights.max()], abs=0.01)
    rim = plaque.vertices[np.isin(plaque.vertices[:, 0], (0, 33)), 2]
    assert np.minimum(abs(rim + 8), abs(rim + 3)).max() <= 0.01


def test_its_volume_is_the_base_and_the_figure(plaque):
    relief, _ = domed()
    h = raised(relief).heights + DEPTH
    cells = (2 * h[:-1, :-1] + h[1:, :-1] + h[:-1, 1:] + 2 * h[1:, 1:]) / 6
    figure = cells.sum() * PITCH**2
    within = 0.01 * relief.mask.sum() * PITCH**2
    assert plaque.volume_mm3 == pytest.approx(33 * 25 * 5 + figure, abs=within)


def test_it_is_a_solid_to_files_too(plaque):
    assert plaque.watertight
    for mesh in ((plaque.vertices, plaque.faces), weld(plaque.vertices, plaque.faces)):
        assert trimesh.Trimesh(*mesh, process=False).is_volume


def test_a_relief_without_a_figure_is_its_base():
    grid = Grid(8, 10, 1.0, (1.0, 9.0))
    empty = Relief(grid, np.zeros((9, 11)), np.zeros((8, 10), bool), 2.0)
    panel = make_plaque(empty, Stock(12.0, 10.0, 3.0))
    assert panel.volume_mm3 == pytest.approx(12 * 10 * 3)
    assert panel.watertight
    with pytest.raises(InputError, match="beyond the stock"):
        make_plaque(empty, Stock(10.0, 10.0, 3.0))
