import numpy as np

from relieffab.layers.image.steps import normals_of, slopes_of


def test_slopes_of_a_plane_and_a_bowl():
    i, j = np.indices((30, 40), float)
    mask = np.ones((30, 40), bool)
    slopes = slopes_of(0.3 * 0.5 * j - 0.7 * 0.5 * i, mask, 0.5)
    np.testing.assert_allclose(slopes[0], 0.3, atol=1e-12)
    np.testing.assert_allclose(slopes[1], 0.7, atol=1e-12)
    x, y = 0.1 * (j - 20), -0.1 * (i - 15)
    bowl = slopes_of(x**2 - 0.5 * y**2, mask, 0.1)[:, 1:-1, 1:-1]
    np.testing.assert_allclose(bowl[0], 2 * x[1:-1, 1:-1], atol=1e-9)
    np.testing.assert_allclose(bowl[1], -y[1:-1, 1:-1], atol=1e-9)


def test_a_jump_is_no_slope():
    i, j = np.indices((30, 40), float)
    depth = 0.2 * j + 9.0 * (j >= 17) + 5.0 * (i >= 11)
    slopes = slopes_of(depth, np.ones((30, 40), bool), 1.0)
    np.testing.assert_allclose(slopes[0], 0.2, atol=1e-12)
    np.testing.assert_allclose(slopes[1], 0.0, atol=1e-12)


def test_slopes_stop_at_the_figure():
    i, j = np.indices((30, 40), float)
    mask = (i - 15) ** 2 + (j - 20) ** 2 < 100
    slopes = slopes_of(np.where(mask, 0.5 * j, -99.0), mask, 1.0)
    np.testing.assert_allclose(slopes[0][mask], 0.5)
    assert (slopes[:, ~mask] == 0).all()


def test_normals_are_unit_and_face_the_viewer():
    slopes = np.array([[[0.0, 1.0, 1e9]], [[0.0, 0.0, 0.0]]])
    normals = normals_of(slopes, np.ones((1, 3), bool))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1.0)
    np.testing.assert_allclose(normals[0, 1], np.array([-1, 0, 1]) / np.sqrt(2))
    assert normals[0, 2, 2] >= 0.0199


def test_a_stone_gives_its_own_normals(stone):
    normals = normals_of(slopes_of(stone.depth, stone.mask, stone.pitch), stone.mask)
    off = np.degrees(np.arccos(np.clip((normals * stone.normals).sum(axis=2), -1, 1)))
    assert np.median(off[stone.mask]) < 1.0
