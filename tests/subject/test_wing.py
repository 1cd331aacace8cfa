"""Feathers lie in order along the arm and overlap."""

import numpy as np
import pytest

from relieffab.subject.wing import ARM, LENGTH, ROWS, half_widths, quills


@pytest.mark.parametrize("row", ROWS)
def test_quills_start_on_the_arm_and_have_their_length(row):
    courses = quills(row)
    assert courses.shape == (row.count, 6, 2)
    length = np.linalg.norm(np.diff(courses, axis=1), axis=2).sum(axis=1)
    assert (length >= row.reach * min(LENGTH) - 1e-9).all()
    assert (length <= row.reach * max(LENGTH) + 1e-9).all()
    if row.shift == 0:
        np.testing.assert_allclose(courses[[0, -1], 0], np.array([ARM[0], ARM[-1]])[:, :2])


@pytest.mark.parametrize("row", ROWS)
def test_neighbours_overlap_unless_they_would_be_clumsy(row):
    courses = quills(row)
    half = half_widths(courses)[:, 1:]
    gaps = np.linalg.norm(np.diff(courses, axis=0), axis=2)[:, 1:]
    shared = half[1:] + half[:-1]
    assert ((shared > gaps) | (half[1:] == 3.0) | (half[:-1] == 3.0)).all()


def test_higher_rows_are_shorter():
    assert [row.reach for row in ROWS] == sorted((row.reach for row in ROWS), reverse=True)
    assert [row.height for row in ROWS] == sorted(row.height for row in ROWS)
