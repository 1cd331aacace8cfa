import numpy as np
import pytest

from relieffab.panel import simplify as module
from relieffab.panel.model import Surface
from relieffab.panel.simplify import deviation, folded, is_sound, simplify
from relieffab.panel.sinking import sink
from relieffab.panel.triangulate import outline, triangulate
from relieffab.stock import Stock

STOCK = Stock(60, 60, 10)
TOLERANCE = 0.02


@pytest.fixture
def sinking(bumpy):
    return sink(bumpy, STOCK)


@pytest.fixture
def surface(sinking):
    return triangulate(sinking, TOLERANCE / 2)


def worst(surface, sinking):
    return max(part.max() for part in deviation(surface, sinking))


def test_fewer_triangles_within_the_tolerance(surface, sinking):
    found = simplify(surface, sinking, TOLERANCE)
    assert len(found.faces) < 0.75 * len(surface.faces)
    assert worst(found, sinking) <= TOLERANCE
    assert is_sound(found, surface)
    assert not folded(found).any()


def test_the_outline_stays_to_the_last_bit(surface, sinking):
    def edges(s):
        return {(tuple(a), tuple(b)) for a, b in s.vertices[outline(s.faces)].tolist()}

    found = simplify(surface, sinking, TOLERANCE)
    assert edges(found) == edges(surface)


def test_a_reduction_too_coarse_is_rejected(surface, sinking, monkeypatch):
    walls = module._walls(surface)
    coarse = module._collapse(surface, walls, 40 * TOLERANCE / sinking.grid.pitch)
    assert worst(coarse, sinking) > 2 * TOLERANCE
    monkeypatch.setattr(module, "PASSES", ((40.0, 1),))
    assert simplify(surface, sinking, TOLERANCE) is surface


def test_freezing_saves_a_pass_that_is_too_bold(surface, sinking, monkeypatch):
    monkeypatch.setattr(module, "PASSES", ((10.0, 8),))
    found = simplify(surface, sinking, TOLERANCE)
    assert len(found.faces) < len(surface.faces)
    assert worst(found, sinking) <= TOLERANCE


def test_deviation_of_the_relief_from_itself(sinking):
    assert worst(triangulate(sinking, 0.0), sinking) < 1e-12


def test_deviation_sees_one_node_moved(sinking):
    exact = triangulate(sinking, 0.0)
    vertices = exact.vertices.copy()
    node = int(np.flatnonzero((exact.vertices[:, :2] == (40, -30)).all(axis=1))[0])
    vertices[node, 2] += 0.1 / sinking.grid.pitch
    nodes, centres = deviation(Surface(exact.grid, vertices, exact.faces), sinking)
    assert np.argwhere(nodes > 1e-9).tolist() == [[30, 40]]
    assert nodes.max() == pytest.approx(0.1)
    assert centres.max() == pytest.approx(0.05)


def test_a_hole_is_the_face_uncut(surface, sinking):
    kept = surface.vertices[surface.faces][:, :, 0].max(axis=1) < 50
    holed = Surface(surface.grid, surface.vertices, surface.faces[kept])
    nodes, _ = deviation(holed, sinking)
    assert (nodes[:, 52:] == -sinking.heights[:, 52:]).all()
    assert nodes[:, :45].max() <= TOLERANCE
    assert not is_sound(holed, surface)


def test_a_doubled_triangle_is_not_sound(surface):
    faces = np.concatenate([surface.faces, surface.faces[:1]])
    assert not is_sound(Surface(surface.grid, surface.vertices, faces), surface)


def test_a_fold_is_seen(surface):
    faces = surface.faces.copy()
    faces[7] = faces[7, ::-1]
    found = folded(Surface(surface.grid, surface.vertices, faces))
    assert np.flatnonzero(found).tolist() == [7]


def test_a_fold_counts_as_out_of_tolerance(surface, sinking):
    faces = surface.faces.copy()
    faces[7] = faces[7, ::-1]
    turned = Surface(surface.grid, surface.vertices, faces)
    assert worst(turned, sinking) <= TOLERANCE
    row, col = module._node_of(surface, np.arange(len(faces)) == 7)
    out = module._out_of_tolerance(turned, sinking, TOLERANCE)
    assert np.argwhere(out).tolist() == [[row[0], col[0]]]


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
    assert calls == [("simplify", 0, 2), ("simplify", 1, 2), ("simplify", 2, 2)]
