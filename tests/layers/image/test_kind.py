import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.image.kind import check_shown, kind_of


def test_kinds_are_told_by_values(stone, depth_map, normal_map, make_picture):
    assert kind_of(depth_map(stone, 16)[0]) == "depth"
    assert kind_of(depth_map(stone, None)[0]) == "depth"
    assert kind_of(normal_map(stone, 8)) == "normal"
    assert kind_of(make_picture(stone.normals, bits=None)) == "normal"
    for bits in (8, 16):
        assert kind_of(make_picture(1 - stone.lines, bits=bits)) == "drawing"
    grey = np.repeat(stone.shading[0][..., None], 3, axis=2) * [1.0, 0.9, 0.7]
    assert kind_of(make_picture(grey)) == "photo"
    assert kind_of(make_picture(grey[..., 0])) == "photo"


def test_one_colour_shows_nothing_but_where_alpha_tells(make_picture):
    for level in (0.0, 0.4, 1.0):
        with pytest.raises(InputError, match="all of one colour"):
            check_shown(make_picture(np.full((20, 20), level)))
    check_shown(make_picture(np.zeros((20, 20)), alpha=np.eye(20)))


def test_nothing_but_nan_or_transparency_shows_nothing(make_picture):
    for picture in (
        make_picture(np.full((20, 20), np.nan), bits=None),
        make_picture(np.eye(20), alpha=np.zeros((20, 20))),
    ):
        with pytest.raises(InputError, match="shows nothing"):
            check_shown(picture)
