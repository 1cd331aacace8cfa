"""PNG bytes give back what was put in."""

import io

import numpy as np
import pytest
from PIL import Image

from relieffab.errors import InputError
from relieffab.picture import png8, png16, smaller


def read(data):
    return np.asarray(Image.open(io.BytesIO(data)))


def test_sixteen_bits_survive():
    grey = np.linspace(0, 1, 65536).reshape(256, 256)
    back = read(png16(grey))
    assert len(np.unique(back)) == 65536
    np.testing.assert_array_equal(back.ravel(), np.arange(65536))


@pytest.mark.parametrize("shape", [(5, 7), (5, 7, 3)])
def test_eight_bits_survive(shape):
    image = np.random.default_rng(3).integers(0, 256, shape).astype(np.uint8)
    np.testing.assert_array_equal(read(png8(image)), image)


@pytest.mark.parametrize("bad", [np.array([[0.0, 1.5]]), np.array([[-0.1]]), np.array([[np.nan]])])
def test_grey_out_of_range_is_refused(bad):
    with pytest.raises(InputError, match="0 to 1"):
        png16(bad)


def test_floats_are_no_eight_bit_picture():
    with pytest.raises(InputError, match="uint8"):
        png8(np.zeros((4, 4)))


@pytest.mark.parametrize(("shape", "small"), [((30, 40, 3), (15, 20, 3)), ((9, 7), (9, 7))])
def test_a_picture_is_made_smaller_not_larger(shape, small):
    image = np.full(shape, 77, np.uint8)
    assert smaller(image, 20).shape == small
    assert (smaller(image, 20) == 77).all()
