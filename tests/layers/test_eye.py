import numpy as np

from relieffab.layers.eye import Eye

EYE = Eye(3.0, -2.0, 1 / 40)
POINTS = np.random.default_rng(1).uniform([-20, -20, -60], [20, 20, 0], (50, 3))


def test_lines_of_sight_fall_straight_down():
    at = np.array([3.0, -2.0, 40.0])
    for share in (0.3, 0.7):
        between = at + share * (POINTS - at)
        np.testing.assert_allclose(EYE.project(between)[:, :2], EYE.project(POINTS)[:, :2])
    nearer = at + 0.9 * (POINTS - at)
    assert (EYE.project(nearer)[:, 2] > EYE.project(POINTS)[:, 2]).all()


def test_the_matrix_is_the_same_map():
    homogeneous = np.column_stack([POINTS, np.ones(50)]) @ EYE.matrix.T
    np.testing.assert_allclose(homogeneous[:, :3] / homogeneous[:, 3:], EYE.project(POINTS))


def test_the_plane_at_zero_stays():
    flat = POINTS * [1, 1, 0]
    np.testing.assert_allclose(EYE.project(flat), flat)


def test_towards_points_at_the_eye():
    to = np.array([3.0, -2.0, 40.0]) - POINTS
    want = to / np.linalg.norm(to, axis=1, keepdims=True)
    np.testing.assert_allclose(EYE.towards(POINTS), want)


def test_normals_of_the_bent_surface():
    rng = np.random.default_rng(2)
    along = rng.normal(size=(2, 50, 3))
    normals = np.cross(*along)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    h = 1e-6
    seen = [EYE.project(POINTS + h * d) - EYE.project(POINTS - h * d) for d in along]
    want = np.cross(*seen)
    want /= np.linalg.norm(want, axis=1, keepdims=True)
    np.testing.assert_allclose(EYE.bend_normals(POINTS, normals), want, atol=1e-6)


def test_an_eye_infinitely_far_changes_nothing():
    far = Eye(5.0, 7.0)
    np.testing.assert_allclose(far.project(POINTS), POINTS)
    np.testing.assert_array_equal(far.towards(POINTS), np.tile([0.0, 0, 1], (50, 1)))
    unit = POINTS / np.linalg.norm(POINTS, axis=1, keepdims=True)
    np.testing.assert_allclose(far.bend_normals(POINTS, unit), unit, atol=1e-12)


def test_what_turns_away_from_the_eye_turns_away_from_straight_above():
    normals = np.random.default_rng(3).normal(size=(50, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    facing = np.einsum("nk,nk->n", normals, EYE.towards(POINTS))
    bent = EYE.bend_normals(POINTS, normals)[:, 2]
    assert (np.sign(facing) == np.sign(bent)).all()
