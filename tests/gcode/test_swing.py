import itertools
from math import pi

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.gcode.slab import Slab
from relieffab.gcode.sweep import profile_numbers, profile_points
from relieffab.gcode.swing import profile_slope
from relieffab.grid import Grid
from relieffab.stock import Stock

COMMON = {"flute_length": 20.0, "stepdown": 1.0, "feed": 500.0, "plunge": 100.0, "rpm": 1e4}
CUTTERS = {
    "flat": Cutter("flat", "flat", 3.0, **COMMON),
    "ball": Cutter("ball", "ball", 2.0, **COMMON),
    "bull": Cutter("bull", "bull", 3.0, corner_radius=0.5, **COMMON),
    "vee": Cutter("vee", "vee", 3.0, angle=60.0, tip_diameter=0.2, **COMMON),
    "tapered": Cutter("tapered", "tapered ball", 3.0, tip_diameter=1.0, angle=20.0, **COMMON),
    "form": Cutter("form", "form", 2.0, points=((0, 0), (0.4, 0.1), (1, 1)), **COMMON),
}


def slab_of(radius=20.0, size=(10.0, 10.0), pitch=0.25):
    stock = Stock(*size, min(5.0, radius), radius=radius)
    rows, cols = round(size[1] / pitch), round(size[0] / pitch)
    return Slab.over(Grid(rows, cols, pitch, (0.0, rows * pitch)), stock)


def brute(slab, cutter, points, places, samples=500, heights=700):
    """Rays at places (row, column), looked at from below, cut by a cutter at many places."""
    x, y = slab.grid.node_axes()
    radius = slab.radius
    c = np.linspace(radius - 2.2, radius, heights)[:, None]
    at = np.concatenate(
        [a + np.linspace(0, 1, samples)[:, None] * (b - a) for a, b in itertools.pairwise(points)]
    )
    found = []
    for i, j in places:
        p = (y[i] - at[:, 1]) / radius
        away = np.hypot(x[j] - at[:, 0], c * np.sin(p))
        inside = radius + at[:, 2] + cutter.profile(away) < c * np.cos(p)
        hit = inside.any(axis=1)
        found.append(float(c[hit.argmax(), 0] - radius) if hit.any() else 0.0)
    return np.array(found)


MOVES = {
    "along": [[2, 5, -1.0], [8, 5, -1.0]],
    "round": [[5, 2, -1.0], [5, 8, -1.0]],
    "across": [[2.1, 3.2, -0.6], [7.7, 6.9, -1.9]],
    "plunge": [[5.05, 5.1, 1.0], [5.05, 5.1, -1.2]],
    "up": [[6, 7, -2.0], [4, 3, 0.5]],
}


@pytest.mark.parametrize("name", CUTTERS)
@pytest.mark.parametrize("way", MOVES)
def test_rays_are_cut_as_by_a_cutter_at_many_places(name, way):
    slab = slab_of(pitch=0.2)
    points = np.array(MOVES[way], float)
    bites = slab.cut(points, CUTTERS[name])
    assert bites[1] == pytest.approx(-slab.heights.min(), abs=1e-5)
    cut = np.argwhere(slab.heights < 0)
    places = np.random.default_rng(3).choice(cut, 15)
    places = np.concatenate([places, places[:5] + np.array([1, 0]), places[:5] + np.array([0, 1])])
    gap = slab.heights[tuple(places.T)] - brute(slab, CUTTERS[name], points, places)
    # Samples are a little apart: a steep flank leaves more, a rim grazes a ray or misses it.
    assert np.sort(gap)[:-1].max() < 1e-5
    assert np.sort(-gap)[:-2].max() < 0.04


def test_a_flat_end_leaves_a_facet():
    slab = slab_of()
    slab.cut(np.array([[5.0, 5.0, 1.0], [5.0, 5.0, -0.5]]), CUTTERS["flat"])
    row = slab.heights[:, 20].astype(float)
    p = (np.arange(41) * 0.25 - 5.0) / 20.0
    facet = (20.0 - 0.5) / np.cos(p) - 20.0
    under = np.abs((20.0 + facet) * np.sin(p)) < 1.5
    np.testing.assert_allclose(row[under], facet[under], atol=1e-6)
    assert (row[~under] == 0).all()


def test_a_turn_all_round_cuts_a_groove_of_one_depth():
    radius = 6.0
    slab = slab_of(radius, (6.0, 2 * pi * radius), 2 * pi * radius / 150)
    way = np.array([[3.0, 0.0, -0.7], [3.0, 2 * pi * radius, -0.7]])
    slab.cut(way, CUTTERS["ball"])
    np.testing.assert_allclose(slab.heights - slab.heights[:1], 0.0, atol=1e-6)
    assert slab.heights.min() == pytest.approx(-0.7, abs=0.02)


def test_across_the_seam_both_sides_are_cut():
    radius = 6.0
    slab = slab_of(radius, (6.0, 2 * pi * radius), 2 * pi * radius / 150)
    slab.cut(np.array([[3.0, 0.0, 1.0], [3.0, 0.0, -0.7]]), CUTTERS["ball"])
    np.testing.assert_allclose(slab.heights[0], slab.heights[-1], atol=1e-6)
    np.testing.assert_allclose(slab.heights[1:5], slab.heights[-2:-6:-1], atol=1e-6)
    assert slab.heights[2].min() < -0.2


@pytest.mark.parametrize("name", CUTTERS)
def test_slopes_are_those_of_the_profile(name):
    cutter = CUTTERS[name]
    shape, form = profile_numbers(cutter), profile_points(cutter)
    for r in np.linspace(0.03, cutter.radius - 0.05, 17):
        rise = (cutter.profile(r + 1e-6) - cutter.profile(r - 1e-6)) / 2e-6
        if abs(r - cutter.flat_radius) > 1e-3 and abs(r - cutter.arc_end) > 1e-3:
            assert profile_slope(r, shape, form) == pytest.approx(rise, rel=1e-4, abs=1e-6)


def test_what_a_flank_leaves_overhanging_is_no_load():
    # Again 1 mm deeper: rays just beside the rim are met from the side, in their last bit.
    slab = slab_of(10.0, (6.0, 10.0), 0.05)
    down = np.array([[3.0, 5.0, 1.0], [3.0, 5.0, -1.0]])
    slab.cut(down, CUTTERS["flat"])
    bites = slab.cut(down - [0, 0, 1.0], CUTTERS["flat"])
    assert bites[1] == pytest.approx(1.0, abs=0.03)
