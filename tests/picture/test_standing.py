import numpy as np
import pytest
import trimesh

from relieffab.picture.standing import GROUND, standing_picture, turned_to


def test_the_eye_looks_from_the_front_and_above():
    front, back, top = [0, -5, 0], [0, 5, 0], [0, 0, 5]
    x, y, z = turned_to(np.array([front, back, top], float), 0.0, 20.0).T
    assert x.tolist() == [0, 0, 0]
    assert z[0] > z[1]
    assert y[2] > y[1] > y[0]


def test_turning_brings_the_left_side_to_the_front():
    left = np.array([[-5.0, 0, 0]])
    assert turned_to(left, 90.0, 0.0)[0] == pytest.approx([0, 0, 5])


def test_a_column_stands_before_the_ground():
    mesh = trimesh.creation.cylinder(10, 30, sections=64)
    image = standing_picture(mesh, width=240, turns=(0.0, 90.0))
    assert image.shape[1:] == (240, 3)
    assert (image[0, 0] == GROUND).all()
    middle = image[image.shape[0] // 2]
    assert (middle[60] != GROUND).any() and (middle[180] != GROUND).any()
    # A column looks the same from every side.
    assert np.abs(image[:, :120].astype(int) - image[:, 120:]).mean() < 2
    # Light comes from the left.
    assert middle[25].sum() > middle[95].sum()
