import numpy as np
import pytest

from relieffab.layers.eye import Eye
from relieffab.layers.lines.surface import bounding_radius
from relieffab.subject import shapes


def test_size_and_radius_are_of_the_whole(prepared):
    ball = prepared(*shapes.sphere(5.0, 800))
    assert ball.radius == pytest.approx(5.0, rel=0.01)
    assert ball.size == pytest.approx(0.25, rel=0.01)
    assert bounding_radius(np.empty((0, 3))) == 0.0


def test_creases_are_parted_so_that_sides_stay_flat(prepared, rotation):
    vertices, faces = shapes.box((1.0, 2.0, 3.0))
    surface = prepared(vertices @ rotation(0.7, 0.4).T, faces)
    assert len(surface.vertices) == 8 + 24
    used = surface.bend.areas > 0
    assert used.sum() == 24
    np.testing.assert_allclose(surface.bend.principal[:, used], 0.0, atol=1e-9)


def test_facing_is_seen_from_the_eye(prepared):
    vertices, faces = shapes.sphere(5.0, 3000)
    near = prepared(vertices - [0, 0, 5.0], faces, eye=Eye(nearness=1 / 10))
    seen = near.facing > 0
    # From 15 mm off its middle, a ball of 5 mm shows a cap of arccos(1/3).
    assert seen.mean() == pytest.approx((1 - 1 / 3) / 2, abs=0.01)


def test_principal_frame_holds_the_view_but_for_its_normal_part(prepared, rotation):
    vertices, faces = shapes.torus(3.0, 1.0, (40, 30))
    surface = prepared(vertices @ rotation(0.5, 0.1).T, faces)
    u, w = surface.in_principal_frame()
    np.testing.assert_allclose(u**2 + w**2 + surface.facing**2, 1.0)
