import numpy as np
import trimesh

from relieffab.panel.weld import weld


def test_a_box_stays_a_box():
    box = trimesh.creation.box((1, 2, 3))
    vertices, faces = weld(np.array(box.vertices), np.array(box.faces))
    assert (len(vertices), len(faces)) == (8, 12)
    assert trimesh.Trimesh(vertices, faces, process=False).is_volume


def test_a_corridor_without_width_closes():
    # Two tetrahedra side by side, joined by a strip narrower than single precision.
    a, b = np.array([1.0, 1, 0]), np.array([1.0, 1 + 1e-12, 0])
    p, q, up, down = np.array([[0.0, 1, 0], [2, 1, 0], [1, 2, 1], [1, 0, 1]])
    vertices = np.array([a, b, p, q, up, down])
    strip = [[0, 3, 2], [1, 2, 3]]
    sheets = [[2, 4, 1], [1, 4, 3], [0, 5, 2], [3, 5, 0]]
    joined, faces = weld(vertices, np.array(strip + sheets))
    assert len(joined) == 5
    assert len(faces) == 4


def test_triangles_that_lose_a_side_go():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1 + 1e-9, 0, 0], [0, 1, 0]])
    joined, faces = weld(vertices, np.array([[0, 1, 3], [0, 1, 2]]))
    assert (len(joined), len(faces)) == (3, 1)
