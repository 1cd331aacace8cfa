import numpy as np
import pytest

from relieffab.relief.edge import inward_distance, steepness, wall
from relieffab.relief.foot import carved, stand
from relieffab.relief.model import nodes_of
from relieffab.relief.reach import ball, closing
from relieffab.relief.targets import Carving

PITCH = 0.12
CARVING = Carving(depth=3.0, fillet=0.25)


def disc(radius=40.0, size=96):
    i, j = np.indices((size, size)) + 0.5
    return np.hypot(i - size / 2, j - size / 2) < radius


def inside(mask, floor=-1.0, carving=CARVING):
    """A level floor inside the walls of a figure."""
    edge = wall(mask, PITCH, carving.wall_angle, carving.depth)
    heights = np.full(edge.shape, floor)
    return carved(heights, nodes_of(mask), edge, PITCH, carving), edge


def test_an_arc_touches_the_floor_and_the_wall():
    slope, radius, floor = 2.0, 0.5, -1.5
    d = np.linspace(-0.5, 3.0, 7001)
    edge = -slope * np.maximum(d, 0.0)
    found = stand(np.full_like(d, floor), edge, slope, radius)
    normal = np.array([slope, 1.0]) / np.hypot(1.0, slope)
    middle = np.array([(radius - (floor + radius) * normal[1]) / normal[0], floor + radius])
    touch = middle[0] - radius * normal[0]
    arc = (d > touch) & (d < middle[0])
    np.testing.assert_allclose(np.hypot(d - middle[0], found - middle[1])[arc], radius)
    np.testing.assert_array_equal(found[d < touch], edge[d < touch])
    np.testing.assert_array_equal(found[d > middle[0]], floor)
    assert np.abs(np.diff(found)).max() < 2.01 * slope * (d[1] - d[0])


def test_a_shallow_floor_stays_below_the_face():
    found = stand(np.linspace(-0.1, 0.0, 50), np.linspace(-1.0, 0.0, 50), 5.0, 0.3)
    assert found.max() == 0.0
    assert found.min() >= -0.1


@pytest.mark.parametrize("angle", [80.0, 90.0])
def test_the_foot_of_a_wall_shows_no_dots(angle):
    """Heights at a round figure's wall are a function of the distance to it alone."""
    mask, carving = disc(), Carving(depth=3.0, fillet=0.25, wall_angle=angle)
    found, edge = inside(mask, carving=carving)
    away = inward_distance(mask)
    order = np.argsort(away, axis=None)
    floor = (edge.ravel()[order] < -1.05) & (away.ravel()[order] < 8.0)
    assert (np.diff(found.ravel()[order][floor]) < 1e-3).all()
    together = closing(np.maximum(np.where(nodes_of(mask), -1.0, 0.0), edge), PITCH, ball(0.25))
    assert np.diff(together.ravel()[order][floor]).max() > 0.02


def test_what_the_tip_leaves_is_above_floor_and_wall_and_0_outside():
    mask = disc()
    found, edge = inside(mask)
    figure = nodes_of(mask)
    assert (found[figure] >= np.maximum(edge, -1.0)[figure]).all()
    assert found.max() <= 0.0
    assert (found[~figure] == 0.0).all()
    assert found[48, 48] == -1.0


def test_a_slot_narrower_than_the_tip_is_filled():
    mask = np.zeros((60, 60), bool)
    mask[10:50, 28:31] = True
    found, _ = inside(mask, floor=-2.5)
    assert found.min() > -0.35
    floor = np.full((61, 61), -1.0)
    floor[:, 29:31] = -2.0
    wide = np.zeros((60, 60), bool)
    wide[5:55, 5:55] = True
    edge = wall(wide, PITCH, 80.0, 3.0)
    assert carved(floor, nodes_of(wide), edge, PITCH, CARVING)[30, 29] > -1.2


def test_without_a_fillet_the_foot_is_as_round_as_the_lattice_can_show():
    found, edge = inside(disc(), carving=Carving(depth=3.0, fillet=0.0))
    sharp = np.maximum(edge, -1.0)
    assert 0.0 < (found - sharp)[nodes_of(disc())].max() < 0.5 * PITCH * steepness(PITCH, 80.0, 3.0)
