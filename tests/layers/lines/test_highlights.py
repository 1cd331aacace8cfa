from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from relieffab.layers.lines import contours, highlights
from relieffab.layers.lines.chains import resample
from relieffab.layers.lines.surface import FEATURE
from relieffab.subject import shapes

BIG, SMALL = 3.0, 1.2


def torus(prepared, turn):
    vertices, faces = shapes.torus(BIG, SMALL, (240, 168))
    return replace(prepared(vertices @ turn.T, faces), radius=2.0 / FEATURE)


def test_where_kr_vanishes_it_grows_or_falls(prepared, rotation):
    surface = torus(prepared, rotation(1.0, 0.3))
    dark, light = contours.suggestive(surface), highlights.suggestive_highlights(surface)
    np.testing.assert_array_equal(dark.points, light.points)
    assert not ((dark.strength > 0) & (light.strength > 0)).any()
    assert (light.strength > 0.25).sum() > 100


def test_principal_highlights_of_a_torus_against_closed_form(prepared, rotation):
    turn = rotation(0.7, 0.3)
    v = turn[2]
    lines = resample(highlights.principal_highlights(torus(prepared, turn)), 0.01)
    drawn = lines.points[lines.strength > 0.25]
    # e1 runs round the tube: -sin phi (v.radial) + cos phi v.z = 0, on the near side.
    theta = np.linspace(0, 2 * np.pi, 20_000)
    phi = np.arctan2(v[2], np.cos(theta) * v[0] + np.sin(theta) * v[1])
    rho = BIG + SMALL * np.cos(phi)
    truth = np.stack([rho * np.cos(theta), rho * np.sin(theta), SMALL * np.sin(phi)], axis=1)
    truth = truth @ turn.T
    bound = 0.005 * (BIG + SMALL)
    assert cKDTree(truth[:, :2]).query(drawn[:, :2])[0].max() < bound
    assert cKDTree(drawn[:, :2]).query(truth[:, :2])[0].max() < bound
