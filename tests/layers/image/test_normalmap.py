import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.image.normalmap import (
    DOWN,
    UP,
    convention,
    curl,
    slopes_in,
    unit_normals,
    vectors_of,
)


@pytest.mark.parametrize(("down", "way"), [(False, UP), (True, DOWN)])
@pytest.mark.parametrize("bits", [8, 16])
def test_the_way_of_green_is_told_by_data(stone, normal_map, bits, down, way):
    vectors = vectors_of(normal_map(stone, bits, down=down))
    assert convention(vectors, stone.mask) == (way, "data")
    normals = unit_normals(vectors, stone.mask, way)
    off = np.degrees(np.arccos(np.clip((normals * stone.normals).sum(axis=2), -1, 1)))
    assert np.percentile(off[stone.mask], 99) < (1.5 if bits == 8 else 0.2)


def test_a_surface_without_twist_is_read_by_custom():
    x = np.linspace(-0.5, 0.5, 40)
    normals = np.stack(np.broadcast_arrays(x[None, :], 0.0, np.sqrt(1 - x**2)[None, :]), axis=-1)
    normals = np.repeat(normals, 30, axis=0)
    mask = np.ones((30, 40), bool)
    assert convention(normals, mask) == (UP, "custom")
    assert curl(slopes_in(normals, mask), mask) == pytest.approx(0.0, abs=1e-12)


def test_stored_floats_may_be_vectors_themselves(stone, make_picture):
    vectors = vectors_of(make_picture(stone.normals, bits=None))
    np.testing.assert_array_equal(vectors, stone.normals)
    with pytest.raises(InputError, match="three channels"):
        vectors_of(make_picture(stone.depth))
