import numpy as np
import pytest
from PIL import Image

from relieffab.errors import InputError
from relieffab.layers.image.make import Showing, layers_of_picture
from relieffab.relief.make import make_relief
from relieffab.relief.model import nodes_of
from relieffab.relief.targets import Carving

CARVING = Carving(depth=2.0, carve="surface")


def save(values, path, bits=16):
    kind = np.uint16 if bits == 16 else np.uint8
    Image.fromarray(np.rint(values * (2**bits - 1)).astype(kind)).save(path)
    return str(path)


def near(layers):
    """Its depth, 0.05 to 1; 0 beyond the figure."""
    seen = layers.depth[layers.mask]
    return np.where(layers.mask, 0.05 + 0.95 * (layers.depth - seen.min()) / np.ptp(seen), 0.0)


def seen(layers, picture, path, **more):
    showing = Showing("normal", depth_map=path, **more)
    return layers_of_picture(picture, layers.grid, (40.0, 30.0), margin=2.5, showing=showing)


@pytest.fixture(scope="module")
def own(ball):
    return make_relief(ball, CARVING)[0]


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("far", [False, True])
def test_both_maps_give_the_solids_own_relief_across_its_step(
    tmp_path, ball, own, normal_map, bits, far
):
    depth = 1.0 - near(ball) if far else near(ball)
    found = seen(ball, normal_map(ball, 8), save(depth, tmp_path / "depth.png", bits))
    np.testing.assert_array_equal(found.layers.mask, ball.mask)
    assert found.facts["depth_map"]["near"] == ("black" if far else "white")
    assert not any("depth map" in note or "--depth-map" in note for note in found.notes)
    relief = make_relief(found.layers, CARVING)[0]
    off = (relief.heights - own.heights)[nodes_of(ball.mask)] / own.depth
    assert np.sqrt((off**2).mean()) < 0.01


def test_normals_alone_say_that_the_step_is_a_guess(ball, normal_map):
    found = seen(ball, normal_map(ball, 8), None)
    assert found.facts["hidden_edges_mm"] == pytest.approx(50.3, rel=0.1)
    assert any("--depth-map would" in note for note in found.notes)


def test_greys_that_are_not_even_with_depth_are_told(tmp_path, ball, normal_map):
    bent = save(near(ball) ** 1.6, tmp_path / "depth.png")
    found = seen(ball, normal_map(ball, 8), bent)
    assert any("not even with depth" in note for note in found.notes)


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (lambda ball: near(ball)[::-1], "does not show what the normal map shows"),
        (lambda ball: near(ball)[:, :-8], "(?s)does not fit.*160 x 120.*152 x 120"),
        (lambda ball: np.full(ball.mask.shape, 0.5), "level"),
        (lambda ball: (ball.normals + 1) / 2, "no colours"),
    ],
)
def test_what_is_no_depth_map_of_the_figure_is_refused(tmp_path, ball, normal_map, made, said):
    values = made(ball)
    path = save(values, tmp_path / "a.png", 8 if values.ndim == 3 else 16)
    with pytest.raises(InputError, match=said):
        seen(ball, normal_map(ball, 8), path)


def test_a_map_that_knows_little_is_refused(tmp_path, ball, normal_map):
    values = np.where(np.arange(160) < 60, near(ball), np.nan)
    np.save(tmp_path / "a.npy", values)
    with pytest.raises(InputError, match="knows too little"):
        seen(ball, normal_map(ball, 8), str(tmp_path / "a.npy"))


def test_settings_that_say_nothing_are_refused(tmp_path, ball, normal_map, depth_map):
    path = save(near(ball), tmp_path / "a.png")
    with pytest.raises(InputError, match="--image-depth says nothing"):
        seen(ball, normal_map(ball, 8), path, deep=3.0)
    with pytest.raises(InputError, match="with a normal map alone"):
        layers_of_picture(depth_map(ball, 16)[0], ball.grid, (40.0, 30.0), margin=2.5,
                          showing=Showing("depth", depth_map=path))  # fmt: skip
