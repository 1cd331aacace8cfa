import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.image.ink import level_layers
from relieffab.layers.model import Stroke
from relieffab.relief.make import make_relief
from relieffab.relief.targets import Carving

GRID = Grid.on_panel((40.0, 30.0), (320, 240))
ROW, COL = np.indices(GRID.shape)
AREA = (np.abs(ROW - 119.5) < 60) & (np.abs(COL - 99.5) < 60)
INK = 1.0 * ((np.abs(COL - 260) < 4) & (np.abs(ROW - 120) < 80))
X, _ = GRID.to_xy(0, 260.5)
STROKE = Stroke(np.array([[X, 5.0], [X, 25.0]]), "drawn", np.ones(2))


@pytest.fixture
def layers():
    return level_layers(GRID, AREA, INK, (STROKE,))


def test_areas_are_sunk_to_the_whole_depth_with_walls(layers):
    relief, solution = make_relief(layers, Carving(depth=2.0, wall_angle=60.0))
    assert solution is None
    heights = relief.heights
    assert heights[120, 100] == -2.0
    assert heights[120, 200] == 0.0
    # Along a wall, away from its eased top and its foot.
    wall = heights[120, 44:48]
    np.testing.assert_allclose(np.diff(wall) / GRID.pitch, -np.tan(np.radians(60)), rtol=0.02)
    assert relief.mask[120, 260]


def test_narrow_areas_have_a_v_for_a_bottom(layers):
    relief, _ = make_relief(layers, Carving(depth=14.0, wall_angle=45.0, line_depth=0.0))
    assert -relief.heights.min() == pytest.approx(60 * GRID.pitch, abs=0.5)


def test_lines_are_grooves_in_the_face_and_parts_can_be_left_out(layers):
    relief, _ = make_relief(layers, Carving(depth=2.0, line_depth=0.3))
    assert relief.heights[120, 260] == pytest.approx(-0.3, abs=0.02)
    lines, _ = make_relief(layers, Carving(depth=2.0, line_depth=0.3, carve="lines"))
    assert lines.heights.min() == pytest.approx(-0.3, abs=0.02)
    assert not lines.mask[120, 100]
    surface, _ = make_relief(layers, Carving(depth=2.0, carve="surface"))
    assert surface.heights[:, 230:].min() == 0


def test_lines_may_take_the_cutters_shape(layers):
    def tip(r):
        return np.asarray(r) / np.tan(np.radians(30))

    relief, _ = make_relief(layers, Carving(depth=2.0, line_depth=0.5, line_tip=tip, fillet=0.0))
    row = relief.heights[120, 256:265]
    assert row.min() == pytest.approx(-0.5, abs=0.12)
    away = np.abs(np.arange(256, 265) - 260.5) * GRID.pitch
    np.testing.assert_allclose(row, np.minimum(away / np.tan(np.radians(30)) - 0.5, 0), atol=0.02)
