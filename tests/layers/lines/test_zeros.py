import numpy as np

from relieffab.layers.eye import Eye
from relieffab.layers.lines.zeros import edge_lines, zero_set
from relieffab.subject import shapes


def tilted_torus(prepared, rotation, **options):
    vertices, faces = shapes.torus(3.0, 1.2, (24, 16))
    return prepared(vertices @ rotation(0.9, 0.2).T, faces, **options)


def test_crossings_lie_on_edges_where_the_field_vanishes(prepared, rotation):
    surface = tilted_torus(prepared, rotation)
    field = surface.vertices @ np.array([0.3, 0.5, 0.8]) - 0.1
    chains = zero_set(surface, field, field[None], lambda c: c[0])
    np.testing.assert_allclose(chains.strength, 0.0, atol=1e-12)
    np.testing.assert_allclose(chains.points @ [0.3, 0.5, 0.8], 0.1, atol=1e-12)
    np.testing.assert_array_equal(
        chains.points[chains.begin[:-1]], chains.points[chains.begin[1:] - 1]
    )


def test_a_field_that_vanishes_on_vertices_still_gives_whole_lines(prepared):
    surface = prepared(*shapes.torus(3.0, 1.2, (24, 16)))
    field = surface.vertices[:, 2].round(9)
    chains = zero_set(surface, field, field[None], lambda c: np.ones_like(c[0]))
    assert len(chains.begin) == 3
    assert np.isfinite(chains.points).all()


def test_the_sense_of_a_direction_does_not_matter(prepared, rotation):
    surface = tilted_torus(prepared, rotation)
    field = surface.vertices[:, 0] - 0.123
    along = np.broadcast_to([0.0, 1.0, 0.0], surface.vertices.shape)
    flips = np.where(np.random.default_rng(0).random(len(field)) < 0.5, -1.0, 1.0)
    plain = zero_set(surface, field, field[None], lambda c: c[0], along=along)
    flipped = zero_set(
        surface, flips * field, field[None], lambda c: c[0], along=flips[:, None] * along
    )
    assert len(plain.points) > 20
    np.testing.assert_allclose(np.sort(plain.points, 0), np.sort(flipped.points, 0), atol=1e-12)


def test_lines_are_projected_as_points_of_the_surface_are(prepared, rotation):
    eye = Eye(0.5, -0.3, 0.1)
    surface = tilted_torus(prepared, rotation, eye=eye)
    field = surface.vertices @ np.array([0.3, 0.5, 0.8]) - 0.1
    chains = zero_set(surface, field, field[None], lambda c: c[0])
    # A plane of the true shape is a plane of what is seen.
    plane = np.array([0.3, 0.5, 0.8, -0.1]) @ np.linalg.inv(eye.matrix)
    np.testing.assert_allclose(chains.points @ plane[:3] + plane[3], 0.0, atol=1e-12)


def test_edge_lines_join():
    corners = np.arange(12.0).reshape(4, 3)
    square = edge_lines(
        corners, np.array([[0, 1], [3, 1], [3, 2], [2, 0]]), np.array([0.1, 0.6, 0.2, 0.3])
    )
    assert square.begin.tolist() == [0, 5]
    assert (square.strength == 1).all()
    # A corner is as steep as the steeper of its edges.
    by_corner = dict(zip(map(tuple, square.points), square.normals[:, 0], strict=True))
    np.testing.assert_allclose([by_corner[tuple(c)] for c in corners], [0.3, 0.6, 0.3, 0.6])
