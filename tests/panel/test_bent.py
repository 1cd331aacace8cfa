import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.bend import Bend
from relieffab.panel.bent import INSIDE, bent_error, refine, sags
from relieffab.panel.solid import is_watertight

BOX = np.array(list(np.ndindex(2, 2, 2)), float)
FANS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
FACES = np.array([half for a, b, c, d in FANS for half in ((a, b, c), (a, c, d))])


def volume(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def test_a_bent_bar_has_the_volume_of_its_piece_of_a_ring():
    bend = Bend(40, 50)
    bar = BOX * [100, 10, 4] - [0, 0, 4]
    vertices, faces = refine(bar, FACES, 36, 0.001)
    assert is_watertight(faces)
    assert volume(vertices, faces) == pytest.approx(volume(bar, FACES))
    exact = 100 / 40 / 2 * (40**2 - 36**2) * 10
    assert volume(bend.bent(vertices), faces) == pytest.approx(exact, rel=2e-4)


def test_every_edge_is_within_its_sag():
    vertices, faces = refine(BOX * [30, 10, 3] - [0, 0, 3], FACES, 20, 0.01)
    edges = vertices[faces] - vertices[np.roll(faces, 1, axis=1)]
    assert sags(edges.reshape(-1, 3), 20).max() <= 0.01


def test_nothing_is_halved_that_need_not_be():
    vertices, faces = refine(BOX, FACES, 1000, 0.1)
    assert (len(vertices), len(faces)) == (8, 12)


@given(
    st.lists(st.tuples(*[st.floats(0, 1)] * 3), min_size=3, max_size=3),
    st.tuples(st.floats(0.05, 1), st.floats(0, 1), st.floats(0, 1)),
)
def test_the_sag_bounds_the_error_of_a_triangle(corners, weights):
    # A triangle at most 3 mm wide and high at a radius of 40: its chord plane against the
    # height that the flat triangle has at the same place.
    bend = Bend(40, 0)
    flat = np.array(corners) * [3, 3, 3] - [1.5, 0, 3]
    area = np.linalg.det(np.column_stack([flat[:, :2], np.ones(3)]))
    if abs(area) < 0.5:
        return
    w = np.array(weights) / sum(weights)
    ((x, y, h),) = bend.flat(w[None, :] @ bend.bent(flat))
    share = np.linalg.solve(np.column_stack([flat[:, :2], np.ones(3)]).T, [x, y, 1])
    bound = INSIDE * sags(flat - np.roll(flat, 1, axis=0), 37).max()
    gx, gy, _ = np.linalg.solve(np.column_stack([flat[:, :2], np.ones(3)]), flat[:, 2])
    assert abs(h - share @ flat[:, 2]) / np.hypot(1, np.hypot(gx, gy)) <= 1.1 * bound + 1e-9


def test_the_error_sees_a_solid_that_is_not_the_relief(make_relief):
    relief = make_relief(np.full((11, 41), -1.0), rim=0.0)
    bend = Bend(40, 20)
    for depth, off in ((1.0, 0.0), (1.3, 0.3)):
        vertices, faces = refine(BOX * [40, 10, depth] - [0, 0, depth], FACES, 38, 0.001)
        # Turned inside out, its floor faces out as the cut's does.
        error = bent_error(bend.bent(vertices), faces[:, ::-1], relief, bend)
        assert error == pytest.approx(off, abs=0.002)
