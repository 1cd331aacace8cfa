"""Signed distances against what geometry says."""

import numpy as np
import pytest

from relieffab.subject import sdf
from relieffab.subject.sdf import Point


@pytest.fixture
def p():
    xyz = np.random.default_rng(7).uniform(-6, 6, (3, 4000))
    return Point(*xyz)


def test_ellipsoid_of_equal_radii_is_a_ball(p):
    found = sdf.ellipsoid(p, (1, -2, 0.5), (3, 3, 3))
    true = np.sqrt((p.x - 1) ** 2 + (p.y + 2) ** 2 + (p.z - 0.5) ** 2) - 3
    np.testing.assert_allclose(found, true, atol=1e-12)


def test_ellipsoid_is_right_to_first_order_at_its_surface():
    radii = np.array([5.0, 3.0, 2.0])
    direction = np.random.default_rng(1).normal(size=(500, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    surface = direction * radii
    normal = surface / radii**2
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    for off in (-0.02, 0.0, 0.02):
        found = sdf.ellipsoid(Point(*(surface + off * normal).T), (0, 0, 0), radii)
        np.testing.assert_allclose(found, off, atol=1e-3)


def test_ellipsoid_centre_is_inside():
    zero = np.zeros(1)
    assert sdf.ellipsoid(Point(zero, zero, zero), (0, 0, 0), (5, 3, 2))[0] == -2


def test_capsule_is_the_distance_to_a_segment(p):
    a, b = np.array([-2.0, 1.0, 0.0]), np.array([3.0, -1.0, 2.0])
    found = sdf.cone(p, a, b, (1.2, 1.2))
    points = np.stack(p, axis=1)
    t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    true = np.linalg.norm(points - (a + t[:, None] * (b - a)), axis=1) - 1.2
    np.testing.assert_allclose(found, true, atol=1e-12)


def test_cone_is_the_nearest_of_many_balls(p):
    a, b = np.array([-2.0, 0.0, 1.0]), np.array([3.0, 1.0, -1.0])
    found = sdf.cone(p, a, b, (2.0, 0.5))
    t = np.linspace(0, 1, 2001)[:, None]
    centres, radii = a + t * (b - a), 2.0 - 1.5 * t[:, 0]
    points = np.stack(p, axis=1)[:400]
    balls = np.linalg.norm(points[:, None] - centres[None], axis=2) - radii
    np.testing.assert_allclose(found[:400], balls.min(axis=1), atol=1e-5)


def test_torus_is_the_distance_to_a_circle(p):
    found = sdf.torus(p, (0.5, 0, 1), 3.0, 0.75)
    angle = np.linspace(0, 2 * np.pi, 4000)
    ring = np.stack([0.5 + 3 * np.cos(angle), 3 * np.sin(angle), np.ones_like(angle)], axis=1)
    points = np.stack(p, axis=1)[:300]
    true = np.linalg.norm(points[:, None] - ring[None], axis=2).min(axis=1) - 0.75
    np.testing.assert_allclose(found[:300], true, atol=1e-4)


def test_disc_ignores_height(p):
    np.testing.assert_allclose(sdf.disc(p, (1, 2), 2.5), np.hypot(p.x - 1, p.y - 2) - 2.5)


def test_straight_stroke_measures_along_and_across():
    x, y = np.array([1.0, 4.0, 12.0]), np.array([0.5, -1.0, 0.0])
    s = sdf.stroke(Point(x, y, np.zeros(3)), [(0, 0), (6, 0), (10, 0)], [2, 2, 2])
    np.testing.assert_allclose(s.distance, [-1.5, -1.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(s.along, [1, 4, 12], atol=1e-12)
    np.testing.assert_allclose(s.across, [-0.25, 0.5, 0.0], atol=1e-12)


def test_blend_is_local_and_as_deep_as_it_says():
    a = np.array([0.0, 0.0, 0.0])
    b = np.array([0.0, 0.5, 3.0])
    joined = sdf.union(a, b, 1.0)
    np.testing.assert_allclose(joined, [-1 / 6, -(0.5**3) / 6, 0.0], atol=1e-12)
    np.testing.assert_allclose(sdf.union(a, b), np.minimum(a, b))
    np.testing.assert_allclose(sdf.common(a, b, 1.0), [1 / 6, 0.5 + 0.5**3 / 6, 3.0], atol=1e-12)


def test_groove_stops_at_its_depth():
    height = np.array([-3.0, -1.0, -0.5, 0.5])
    cut = sdf.groove(height, np.full(4, -9.0), 0.8)
    np.testing.assert_allclose(cut, height + 0.8)
    np.testing.assert_allclose(sdf.groove(height, np.full(4, 9.0), 0.8), height)


def test_bezier_passes_its_ends_and_its_middle():
    points = [(0, 0), (0, 4), (4, 4), (4, 0)]
    found = sdf.bezier(points, [0, 0.5, 1])
    np.testing.assert_allclose(found, [(0, 0), (2, 3), (4, 0)])


def test_open_single_precision_grids_stay_so():
    axis = np.linspace(-1, 1, 5, dtype=np.float32)
    p = Point(axis[:, None, None], axis[None, :, None], axis[None, None, :])
    for field in (
        sdf.ellipsoid(p, (0, 0, 0), (1, 2, 3)),
        sdf.cone(p, (0, 0, 0), (1, 1, 1), (1, 0.5)),
        sdf.torus(p, (0, 0, 0), 1, 0.2),
    ):
        assert field.shape == (5, 5, 5)
        assert field.dtype == np.float32
