from dataclasses import replace

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.image.make import Showing, layers_of_picture
from relieffab.relief.make import make_relief
from relieffab.relief.model import nodes_of
from relieffab.relief.targets import Carving

CARVING = Carving(depth=2.0)


def seen(picture, stone, **showing):
    return layers_of_picture(
        picture, stone.grid, (40.0, 30.0), margin=3.0, showing=Showing(**showing)
    )


@pytest.fixture(scope="module")
def own(stone):
    """The mesh's own relief."""
    return make_relief(stone, CARVING)[0]


def off(relief, own, stone):
    """RMS and largest difference in the figure, of the depth."""
    d = (relief.heights - own.heights)[nodes_of(stone.mask)] / own.depth
    return np.sqrt((d**2).mean()), np.abs(d).max()


@pytest.mark.parametrize("bits", [8, 16, None])
@pytest.mark.parametrize("far", [False, True])
def test_a_depth_map_gives_the_meshs_own_relief(stone, own, depth_map, bits, far):
    picture, deep = depth_map(stone, bits, white_far=far)
    found = seen(picture, stone, kind="depth", deep=deep)
    assert found.facts["near"] == ("black" if far else "white")
    assert (found.facts["banding"] is not None) == (bits == 8)
    np.testing.assert_array_equal(found.layers.mask, stone.mask)
    rms, most = off(make_relief(found.layers, CARVING)[0], own, stone)
    assert rms < 0.01
    assert most < 0.08


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("down", [False, True])
def test_a_normal_map_gives_the_meshs_own_relief(stone, own, normal_map, bits, down):
    found = seen(normal_map(stone, bits, down=down), stone)
    assert found.facts["kind"] == "normal"
    assert found.facts["green"] == ("y-down" if down else "y-up")
    rms, most = off(make_relief(found.layers, CARVING)[0], own, stone)
    assert rms < 0.01
    assert most < 0.08


def test_a_map_of_256_plateaus_gives_no_plateaus(stone, depth_map):
    picture, deep = depth_map(stone, 8)
    layers = seen(picture, stone, kind="depth", deep=deep).layers
    surface = replace(CARVING, carve="surface")
    heights = make_relief(layers, surface)[0].heights[nodes_of(stone.mask)]
    assert len(np.unique(np.round(heights, 6))) > 0.5 * heights.size


def test_words_settle_what_values_would(stone, depth_map, normal_map):
    picture, deep = depth_map(stone, 16)
    turned = seen(picture, stone, kind="depth-white-far", deep=deep)
    assert turned.facts["near_by"] == "setting"
    plain = seen(picture, stone, kind="depth", deep=deep)
    a, b = turned.layers.depth[stone.mask], plain.layers.depth[stone.mask]
    assert np.corrcoef(a, b)[0, 1] < -0.99
    assert seen(normal_map(stone, 8), stone, kind="normal-y-down").facts["green_by"] == "setting"


def test_a_photograph_has_lines_and_says_how_it_was_read(stone, make_picture):
    shaded = np.where(stone.mask, 0.1 + 0.9 * stone.shading[0], 0.0)
    coarse = Grid.on_panel((40.0, 30.0), (160, 120))
    found = layers_of_picture(make_picture(shaded), coarse, (40.0, 30.0), margin=3.0)
    assert found.facts["kind"] == "photo"
    assert found.facts["mask"] == "even background"
    assert {stroke.kind for stroke in found.layers.strokes} >= {"outline"}
    assert any("taken for a photo" in note for note in found.notes)
