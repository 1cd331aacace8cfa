from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import argrelmax
from scipy.spatial import cKDTree

from relieffab.layers.lines import ridges
from relieffab.layers.lines.chains import resample
from relieffab.layers.lines.surface import FEATURE
from relieffab.subject import shapes

WIDE = 0.5
LOW = 0.25


def profile(x):
    return 0.8 * np.exp(-((x / WIDE) ** 2) / 2)


def wall(prepared, turn, count=200):
    """A Gaussian wall along Y, its vertices uneven."""
    rng = np.random.default_rng(4)

    def surface(u, v):
        free = (u > 0) & (u < 1) & (v > 0) & (v < 1)
        x, y = (4 * (q + 0.3 * free * rng.uniform(-1, 1, len(q)) / count) - 2 for q in (u, v))
        return np.stack([x, y, profile(x)], axis=1)

    vertices, faces = shapes.sheet(surface, (count, count))
    return replace(prepared(vertices @ turn.T, faces), radius=1.0 / FEATURE)


X = np.linspace(-2, 2, 40_001)
Z1 = -X / WIDE**2 * profile(X)
Z2 = (X**2 / WIDE**4 - 1 / WIDE**2) * profile(X)
BENDING = -Z2 / (1 + Z1**2) ** 1.5  # convex is positive


def peaks(values):
    """Where a profile is largest on the spot, strong enough to be drawn."""
    at = argrelmax(values)[0]
    return X[at[values[at] > 0.3]]


def across(lines, turn):
    """X on the wall of the points drawn, its ends left out."""
    points = resample(lines, 0.01)
    inner = points.points @ turn
    return inner[(points.strength > LOW) & (np.abs(inner[:, 1]) < 1.8), 0]


@pytest.mark.parametrize(("tilt", "spin"), [(0.0, 0.0), (0.5, 0.3)])
@pytest.mark.parametrize(("find", "values"), [(ridges.ridges, BENDING), (ridges.valleys, -BENDING)])
def test_ridges_and_valleys_run_where_a_profile_bends_most(
    prepared, rotation, find, values, tilt, spin
):
    turn = rotation(tilt, spin)
    drawn = across(find(wall(prepared, turn)), turn)
    truth = peaks(values)
    assert len(truth) == (1 if find is ridges.ridges else 2)
    off, nearest = cKDTree(truth[:, None]).query(drawn[:, None])
    assert np.percentile(off, 98) < 0.01
    assert set(nearest) == set(range(len(truth)))
    assert len(drawn) > 300 * len(truth)


def test_apparent_ridges_run_where_the_picture_bends_most(prepared, rotation):
    # Seen from above, x runs on the picture as it is: the normal's angle is atan z'.
    turn = rotation(0.0, 0.0)
    drawn = across(ridges.apparent_ridges(wall(prepared, turn)), turn)
    truth = peaks(np.abs(Z2) / (1 + Z1**2))
    off, nearest = cKDTree(truth[:, None]).query(drawn[:, None])
    assert np.percentile(off, 98) < 0.01
    assert set(nearest) == set(range(len(truth)))


def test_seen_bending_of_a_sphere_grows_with_its_slant(prepared):
    surface = prepared(*shapes.sphere(2.0, 4000))
    bending, along = ridges.seen_bending(surface)
    front = surface.facing > 0.1
    # 1/R turned per mm of surface, foreshortened by n.v along the view.
    np.testing.assert_allclose(bending[front] * surface.facing[front], 0.5, rtol=0.03)
    aslant = (surface.facing > 0.2) & (surface.facing < 0.9)
    length = np.linalg.norm(along, axis=1)
    np.testing.assert_allclose(length[aslant] * surface.facing[aslant], 1.0, rtol=0.03)


def test_a_torus_has_no_ridges(prepared):
    surface = prepared(*shapes.torus(3.0, 1.0, (120, 80)))
    assert (ridges.ridges(surface).strength < LOW).mean() > 0.5
    assert (ridges.valleys(surface).strength == 0).all()
