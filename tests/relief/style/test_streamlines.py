import numpy as np
import pytest
from scipy import ndimage
from scipy.spatial import cKDTree

from relieffab.relief.style.field import fixed_field
from relieffab.relief.style.streamlines import STEPS, TEST, Spacing, streamlines

SPACING = Spacing(apart=8.0, shortest=12.0, room=0.5)


def room_of(where):
    return ndimage.distance_transform_edt(np.pad(where, 1))[1:-1, 1:-1]


def circles():
    """Directions around the middle of a ring."""
    row, col = np.indices((161, 161)) - 80.0
    angle = np.arctan2(-row, col) + np.pi / 2
    away = np.hypot(row, col)
    return np.exp(2j * angle), room_of((away > 20) & (away < 78))


def waves():
    row, col = np.indices((150, 200)) / 1.0
    angle = 0.8 * np.sin(col / 30) + 0.6 * np.cos(row / 25)
    return np.exp(2j * angle), room_of(np.ones((150, 200), bool))


def nearest_apart(lines):
    """Distance of every place from the nearest of another line: the plain way."""
    found = []
    for k, line in enumerate(lines):
        rest = np.concatenate([other for n, other in enumerate(lines) if n != k])
        found.append(cKDTree(rest).query(line)[0])
    return np.concatenate(found)


def test_a_straight_field_gives_straight_lines_one_spacing_apart():
    for angle in (0.0, 37.0, 90.0):
        lines = streamlines(
            fixed_field(angle, (150, 200)), room_of(np.ones((150, 200), bool)), SPACING
        )
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        side = [line @ np.array([c, s]) for line in lines]  # square to the lines
        assert max(np.ptp(one) for one in side) < 1e-6
        np.testing.assert_allclose(np.diff(sorted(one.mean() for one in side)), 8.0, atol=0.05)


@pytest.mark.parametrize("case", [circles, waves])
def test_lines_keep_their_distance_and_leave_no_room_for_another(case):
    field, room = case()
    lines = streamlines(field, room, SPACING)
    apart = nearest_apart(lines)
    assert apart.min() > 0.97 * TEST * SPACING.apart
    assert np.median(apart) == pytest.approx(SPACING.apart, rel=0.05)
    away, _ = cKDTree(np.concatenate(lines)).query(np.argwhere(room > 0.5))
    assert np.percentile(away, 98) < SPACING.apart
    assert all(np.ptp(line, axis=0).max() > SPACING.apart for line in lines)


def test_lines_follow_the_field():
    field, room = circles()
    for line in streamlines(field, room, SPACING):
        radius = np.hypot(*(line - 80.0).T)
        assert np.ptp(radius) < 0.01 * radius.mean()
        steps = np.hypot(*np.diff(line, axis=0).T)
        np.testing.assert_allclose(steps, SPACING.apart / STEPS, rtol=1e-6)


def test_a_line_does_not_run_into_itself():
    field, room = circles()
    for line in streamlines(field, room, SPACING):
        k, m = np.triu_indices(len(line), 4 * STEPS)
        assert np.hypot(*(line[k] - line[m]).T).min() > 0.9 * TEST * SPACING.apart


def test_lines_stay_within_their_room_and_patch():
    field, room = waves()
    patch = (np.indices(room.shape).sum(axis=0) > 170).astype(np.int64)
    room = np.where(np.indices(room.shape)[1] > 50, room, 0.0)
    lines = streamlines(field, room, SPACING, patch)
    assert len(lines) > 10
    for line in lines:
        i, j = np.rint(line).astype(int).T
        assert np.ptp(patch[i, j]) == 0
        assert line[:, 1].min() >= 50


def test_no_room_no_lines():
    assert streamlines(fixed_field(0.0, (20, 20)), np.zeros((20, 20)), SPACING) == []
