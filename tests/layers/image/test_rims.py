import numpy as np
import pytest

from relieffab.layers.image.rims import rim_length, rims_of

PITCH, RADIUS = 0.25, 8.0


def test_a_ball_before_a_wall_has_its_circle(ball):
    length = rim_length(ball.normals, ball.mask, PITCH)
    assert length == pytest.approx(2 * np.pi * RADIUS, rel=0.1)


def test_rims_lie_where_the_depth_steps(ball):
    across, down = rims_of(ball.normals, ball.mask)
    m = ball.mask
    both = (m[:, 1:] & m[:, :-1], m[1:] & m[:-1])
    for found, axis, inside in ((across, 1, both[0]), (down, 0, both[1])):
        steps = inside & (np.abs(np.diff(ball.depth, axis=axis)) > 5.0)
        assert (found & ~steps).sum() == 0
        assert (found & steps).sum() > 0.8 * steps.sum()


def test_what_hides_nothing_has_none(stone):
    assert rim_length(stone.normals, stone.mask, PITCH) == 0.0
