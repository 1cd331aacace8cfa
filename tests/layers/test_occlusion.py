import numpy as np
import pytest

from relieffab.layers.occlusion import STEEPEST, beside, occlusions, slopes


def test_slopes_of_a_plane(plane_layers):
    v = slopes(plane_layers(0.3, -0.8))
    np.testing.assert_allclose(v[0], 0.3)
    np.testing.assert_allclose(v[1], -0.8)


def test_slopes_stop_at_the_steepest(plane_layers):
    v = slopes(plane_layers(300.0, 400.0))
    np.testing.assert_allclose(np.hypot(v[0], v[1]), STEEPEST)


@pytest.mark.parametrize(("p", "q"), [(0.0, 0.0), (2.0, -1.0), (6.0, 3.0)])
def test_a_plane_has_no_occlusion_and_a_step_has(plane_layers, p, q):
    smooth = plane_layers(p, q)
    assert not any(o.any() for o in occlusions(smooth, slopes(smooth)))
    torn = plane_layers(p, q, step=0.5 * 2 * (1.1 + max(p, -q)))
    across, down = occlusions(torn, slopes(torn))
    assert across[:, 14].all()
    assert across.sum() == 20
    assert not down.any()


def test_pixels_beside_a_jump_are_both_sides_of_it(plane_layers):
    torn = plane_layers(0.0, 0.0, step=3.0)
    found = beside(*occlusions(torn, slopes(torn)))
    assert found[:, 14:16].all()
    assert found.sum() == 40
