import numpy as np
import pytest

from relieffab.layers.image.outline import faint_share

DOWN, ACROSS = np.mgrid[:80, :100]
DISC = np.hypot(DOWN - 40, ACROSS - 50) < 25


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5])
def test_the_share_is_that_of_the_part_as_bright_as_its_background(share):
    way = np.arctan2(DOWN - 40, ACROSS - 50) / (2 * np.pi) + 0.5
    grey = np.where(DISC & (way > share), 0.8, 0.4)[..., None]
    assert faint_share(grey, DISC) == pytest.approx(share, abs=0.03)
    assert faint_share(np.repeat(grey, 3, axis=2), DISC) == pytest.approx(share, abs=0.03)


def test_the_edge_of_the_picture_is_no_outline():
    half = ACROSS < 50
    assert faint_share(np.where(half, 0.8, 0.2)[..., None], half) == 0.0
    assert faint_share(np.ones((8, 9, 1)), np.ones((8, 9), bool)) == 0.0
