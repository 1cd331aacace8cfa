"""What is drawn comes out as a closed mesh of the right size."""

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.subject.canvas import Canvas
from relieffab.subject.sdf import ellipsoid


def volume(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def ball(centre, radius):
    return lambda p: ellipsoid(p, centre, (radius,) * 3)


def test_ball_is_closed_outward_and_as_large_as_it_should_be():
    canvas = Canvas((12, 12, 12), 0.25)
    canvas.draw(ball((0, 0, 5), 4.0), (0, -4, 1), (4, 4, 9))
    vertices, faces = canvas.mesh()
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    # Softening shrinks a sphere's radius by about cell² / (2 R), chords by as much again.
    assert volume(vertices, faces) == pytest.approx(4 / 3 * np.pi * 64, rel=0.015)
    assert np.abs(np.linalg.norm(vertices - [0, 0, 5], axis=1) - 4).max() < 0.03


def test_only_the_half_that_is_drawn_is_mirrored():
    canvas = Canvas((20, 10, 8), 0.4)
    canvas.draw(ball((5, 0, 3), 2.0), (3, -2, 1), (7, 2, 5))
    vertices, _ = canvas.mesh()
    assert vertices[:, 0].min() == pytest.approx(-7, abs=0.1)
    assert vertices[:, 0].max() == pytest.approx(7, abs=0.1)
    assert np.abs(vertices[:, 0]).min() > 2.9


def test_what_stands_below_zero_is_cut_flat():
    canvas = Canvas((12, 12, 8), 0.3)
    canvas.draw(ball((0, 0, 0), 4.0), (0, -4, -4), (4, 4, 4))
    vertices, faces = canvas.mesh()
    assert vertices[:, 2].min() == pytest.approx(0, abs=1e-3)
    assert volume(vertices, faces) == pytest.approx(2 / 3 * np.pi * 64, rel=0.03)


def test_part_beyond_the_slab_is_left_out():
    canvas = Canvas((12, 12, 8), 0.3)
    canvas.draw(ball((0, 0, 3), 2.0), (0, -2, 1), (2, 2, 5))
    canvas.draw(ball((50, 0, 3), 2.0), (48, -2, 1), (52, 2, 5))
    assert canvas.mesh()[0][:, 0].max() == pytest.approx(2, abs=0.05)


@pytest.mark.parametrize("cell", [0.0, -1.0, 0.01, 50.0, np.nan])
def test_cell_out_of_range_is_refused(cell):
    with pytest.raises(InputError, match="cell"):
        Canvas((10, 10, 10), cell)
