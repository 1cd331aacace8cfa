import numpy as np
import pytest
from scipy import ndimage

from relieffab.relief.classic.methods import METHODS
from relieffab.relief.model import Relief, nodes_of

pytestmark = pytest.mark.parametrize("name", [name for name in METHODS if name != "wang"])


def test_bounds_are_kept_and_reached(name, layers):
    h = METHODS[name](layers, 2.5)
    nodes = nodes_of(layers.mask)
    assert h.dtype == np.float64
    assert h[nodes].min() == -2.5
    assert h[nodes].max() == 0.0
    assert (h[~nodes] == 0).all()
    Relief(layers.grid, h, layers.mask, 2.5)


def test_depth_only_scales(name, layers):
    method = METHODS[name]
    np.testing.assert_allclose(method(layers, 4.0), 4 * method(layers, 1.0), atol=1e-9)


def test_both_resolutions_give_one_relief(name, layers, finer_layers):
    coarse, fine = METHODS[name](layers, 1.0), METHODS[name](finer_layers, 1.0)[::2, ::2]
    inner = ndimage.binary_erosion(nodes_of(layers.mask), iterations=3)
    assert np.sqrt(((coarse - fine)[inner] ** 2).mean()) < 0.04
    assert np.corrcoef(coarse[inner], fine[inner])[0, 1] > 0.99


def test_a_level_plate_stays_at_the_face(name, flat):
    assert not METHODS[name](flat, 2.0).any()


@pytest.mark.filterwarnings("error")
def test_a_few_pixels_are_enough(name, tiny):
    h = METHODS[name](tiny, 2.0)
    assert np.isfinite(h).all()
    assert h.min() >= -2.0
    assert h.max() <= 0.0


@pytest.mark.filterwarnings("error")
def test_a_figure_may_touch_the_border(name, bordering):
    h = METHODS[name](bordering, 2.0)
    assert h[20, 25] > -0.1
    assert max(h[0, 0], h[-1, 0], h[0, -1], h[-1, -1]) < -1.5


def test_the_model_is_left_alone(name, stepped):
    before = stepped.depth.copy()
    METHODS[name](stepped, 2.0)
    np.testing.assert_array_equal(stepped.depth, before)
