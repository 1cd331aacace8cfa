import numpy as np
import pytest
from scipy import ndimage

import relieffab as rf
from relieffab.subject import shapes


@pytest.fixture(scope="module")
def torus():
    return rf.make_mesh(*shapes.torus(3.0, 0.45, (160, 60)), name="torus")


def seen(mesh, perspective=0.0, **options):
    view = rf.View(elevation=35, perspective=perspective)
    drawing = rf.Drawing(**options)
    return rf.make_layers(mesh, view, resolution=(320, 240), drawing=drawing)


def test_ink_follows_width_and_spread(torus):
    usual, bold, spread, thin = (
        seen(torus, **options).lines.sum()
        for options in ({}, {"width": 1.2}, {"spread": 0.4}, {"spread": -0.4})
    )
    assert bold > 1.8 * usual
    assert spread > 1.8 * usual
    assert thin < 0.5 * usual


def test_highlights_are_drawn_but_not_inked(torus):
    plain = seen(torus, kinds=("outline",))
    lit = seen(torus, kinds=("outline", "principal-highlight"))
    assert any(stroke.light for stroke in lit.strokes)
    np.testing.assert_array_equal(lit.lines, plain.lines)


def test_layers_stay_aligned_in_perspective(torus):
    layers = seen(torus, 60.0)
    covered = layers.mask.sum() * layers.pitch**2
    outline = [s.points for s in layers.strokes if s.kind == "outline"]
    areas = [
        abs(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))) / 2
        for p in outline
    ]
    # The figure less its hole.
    assert 2 * max(areas) - sum(areas) == pytest.approx(covered, rel=0.01)
    # Normals are those of the depth that is seen.
    slope = np.gradient(layers.depth, layers.pitch)[1]
    inner = ndimage.binary_erosion(layers.mask, iterations=2) & (layers.normals[..., 2] > 0.6)
    want = -layers.normals[inner, 0] / layers.normals[inner, 2]
    assert np.median(np.abs(slope[inner] - want)) < 0.02
