import numpy as np

from relieffab.panel.edges import edge_keys, has_repeats, outline, plan_areas


def test_repeats_and_open_edges_are_found():
    faces = np.array([[0, 1, 2], [2, 1, 3]])
    assert sorted(map(tuple, outline(faces).tolist())) == [(0, 1), (1, 3), (2, 0), (3, 2)]
    assert not has_repeats(edge_keys(faces))
    assert has_repeats(edge_keys(np.array([[0, 1, 2], [0, 1, 3]])))
    assert outline(np.empty((0, 3), np.int64)).shape == (0, 2)


def test_areas_in_plan_tell_which_way_triangles_turn():
    points = np.array([[0.0, 0, 5], [4, 0, -1], [0, 3, 2], [8, 0, 9]])
    faces = np.array([[0, 1, 2], [0, 2, 1], [0, 1, 3]])
    assert plan_areas(points, faces).tolist() == [12.0, -12.0, 0.0]
