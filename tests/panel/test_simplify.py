import numpy as np
import pytest

from relieffab.panel import simplify as module
from relieffab.panel.edges import outline
from relieffab.panel.model import Surface
from relieffab.panel.simplify import distances, folded, is_sound, simplify
from relieffab.panel.sinking import sink
from relieffab.panel.triangulate import triangulate
from relieffab.stock import Stock

STOCK = Stock(60, 60, 10)
TOLERANCE = 0.02


@pytest.fixture
def sinking(bumpy):
    return sink(bumpy, STOCK)


@pytest.fixture
def surface(sinking):
    return triangulate(sinking, 0.9 * TOLERANCE)


def worst(surface, sinking):
    return distances(surface, sinking).max()


def test_fewer_triangles_within_the_tolerance(surface, sinking):
    found = simplify(surface, sinking, TOLERANCE)
    assert len(found.faces) < 0.97 * len(surface.faces)
    assert worst(found, sinking) <= TOLERANCE
    assert is_sound(found, surface)
    assert not folded(found).any()


def test_the_outline_stays_to_the_last_bit(surface, sinking):
    def edges(s):
        return {(tuple(a), tuple(b)) for a, b in s.vertices[outline(s.faces)].tolist()}

    found = simplify(surface, sinking, TOLERANCE)
    assert edges(found) == edges(surface)


def test_a_reduction_too_coarse_is_rejected(surface, sinking, monkeypatch):
    none = np.zeros(len(surface.faces), bool)
    coarse = module._collapse(surface, none, 40 * TOLERANCE / sinking.grid.pitch)
    assert worst(coarse, sinking) > 2 * TOLERANCE
    monkeypatch.setattr(module, "REACH", 40.0)
    monkeypatch.setattr(module, "TRIES", 1)
    assert simplify(surface, sinking, TOLERANCE) is surface


def test_freezing_saves_a_pass_that_is_too_bold(surface, sinking, monkeypatch):
    monkeypatch.setattr(module, "REACH", 4.0)
    monkeypatch.setattr(module, "TRIES", 9)
    found = simplify(surface, sinking, TOLERANCE)
    assert len(found.faces) < len(surface.faces)
    assert worst(found, sinking) <= TOLERANCE


def test_triangles_are_near_where_boxes_meet(surface):
    bad = Surface(surface.grid, surface.vertices, surface.faces[100:101])
    x, y = surface.vertices[surface.faces, 0], -surface.vertices[surface.faces, 1]
    expected = (
        (x.max(axis=1) >= x[100].min() - 2) & (x.min(axis=1) <= x[100].max() + 2)
        & (y.max(axis=1) >= y[100].min() - 2) & (y.min(axis=1) <= y[100].max() + 2)
    )  # fmt: skip
    assert np.array_equal(module._near(surface, bad, 2), expected)
    assert 1 < expected.sum() < len(expected) / 2


def test_distances_of_the_relief_from_itself(sinking):
    assert worst(triangulate(sinking, 0.0), sinking) < 1e-9


def test_distances_see_one_node_moved(sinking):
    exact = triangulate(sinking, 0.0)
    vertices = exact.vertices.copy()
    node = int(np.argmin(np.hypot(*(exact.vertices[:, :2] - (48, -36)).T)))
    vertices[node, 2] += 0.1 / sinking.grid.pitch
    found = distances(Surface(exact.grid, vertices, exact.faces), sinking)
    around = (exact.faces == node).any(axis=1)
    assert found[around] == pytest.approx(0.1)
    assert found[~around].max() < 1e-9


def test_a_doubled_triangle_is_not_sound(surface):
    faces = np.concatenate([surface.faces, surface.faces[:1]])
    assert not is_sound(Surface(surface.grid, surface.vertices, faces), surface)


def test_a_fold_is_seen(surface):
    faces = surface.faces.copy()
    faces[7] = faces[7, ::-1]
    found = folded(Surface(surface.grid, surface.vertices, faces))
    assert np.flatnonzero(found).tolist() == [7]


def test_nothing_rises_above_the_face(make_relief):
    y, x = np.mgrid[-20:21, -20:21] * 0.25
    h = np.where(np.hypot(x, y) < 4.5, -0.0005 - 0.01 * (x**2 + y**2), 0.0)
    dome = triangulate(sink(make_relief(h, pitch=0.25), STOCK), 0.0)
    found = module._collapse(dome, np.zeros(len(dome.faces), bool), 0.4)
    assert len(found.faces) < 0.7 * len(dome.faces)
    assert found.vertices[:, 2].max() <= 0


def test_it_says_how_far_it_is(surface, sinking):
    calls = []
    simplify(surface, sinking, TOLERANCE, progress=lambda *step: calls.append(step))
    assert calls[0] == ("simplify", 0, 6)
    assert calls[-1] == ("simplify", 6, 6)
