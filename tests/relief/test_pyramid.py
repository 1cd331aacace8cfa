import numpy as np

from relieffab.relief.pyramid import halve, refine


def test_halving_keeps_the_nearest_of_four(layers):
    half = halve(layers)
    assert half.grid.shape == (60, 80)
    near = np.where(layers.mask, layers.depth, -np.inf).reshape(60, 2, 80, 2).max(axis=(1, 3))
    np.testing.assert_array_equal(half.depth[half.mask], near[half.mask])
    assert half.mask.sum() * 4 >= layers.mask.sum()


def test_refining_is_exact_for_cubics_and_keeps_the_nodes():
    x = np.arange(12.0)
    coarse = 0.01 * np.add.outer(x**3, x**2)
    fine = refine(coarse, np.ones((12, 12), bool), (23, 23))
    np.testing.assert_allclose(fine[::2, ::2], coarse)
    half = np.arange(23.0) / 2
    np.testing.assert_allclose(
        fine[2:-2, 2:-2], 0.01 * np.add.outer(half**3, half**2)[2:-2, 2:-2], atol=1e-12
    )


def test_what_lies_outside_the_figure_takes_no_part():
    figure = np.zeros((10, 10), bool)
    figure[3:7, 3:7] = True
    coarse = np.where(figure, -1.5, 99.0)
    np.testing.assert_allclose(refine(coarse, figure, (19, 19))[5:14, 5:14], -1.5)
