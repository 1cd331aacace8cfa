import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.bend import Bend


@given(st.floats(5, 500), st.floats(-0.499, 0.499), st.floats(-50, 50), st.floats(-0.9, 0.5))
def test_flat_undoes_bent(radius, turn, y, share):
    bend = Bend(radius, 17.0)
    point = [[17.0 + turn * bend.around, y, share * radius]]
    np.testing.assert_allclose(bend.flat(bend.bent(point)), point, atol=1e-9 * radius)


def test_a_quarter_of_a_turn_to_the_right_faces_right():
    bend = Bend(40, 0)
    x, y, z = bend.bent([[bend.around / 4, 5, -3]])[0]
    assert (x, y, z) == (pytest.approx(37), 5, pytest.approx(0, abs=1e-12))


def test_lengths_on_the_face_stay():
    bend = Bend(40, 60)
    x = np.linspace(0, 120, 2001)
    points = bend.bent(np.stack([x, 0 * x, 0 * x], axis=1))
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() == pytest.approx(120, rel=1e-6)
