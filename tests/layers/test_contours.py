from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import interp1d
from scipy.spatial import cKDTree
from skimage.measure import find_contours

from relieffab.layers import contours
from relieffab.layers.chains import find_edges, resample

BIG, SMALL = 3.0, 1.2
LOW = 0.25


def turn(tilt, spin):
    """Rotation after which the viewer, on +Z, sees the Z axis tilted by `tilt` radians."""
    c, s, cs, ss = np.cos(tilt), np.sin(tilt), np.cos(spin), np.sin(spin)
    about_x = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return about_x @ np.array([[cs, -ss, 0], [ss, cs, 0], [0, 0, 1]])


def torus(m, n):
    i, j = (q.ravel() for q in np.meshgrid(np.arange(m), np.arange(n), indexing="ij"))
    points = on_torus(2 * np.pi * i / m, 2 * np.pi * j / n)
    a, b = i * n + j, (i + 1) % m * n + j
    c, d = (i + 1) % m * n + (j + 1) % n, i * n + (j + 1) % n
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def on_torus(theta, phi):
    rho = BIG + SMALL * np.cos(phi)
    return np.stack([rho * np.cos(theta), rho * np.sin(theta), SMALL * np.sin(phi)], axis=-1)


def prepared(points, faces, **options):
    edges = find_edges(faces, len(points))
    sharp = contours.sharp_edges(points, faces, edges, 40.0)
    return contours.prepare(points, faces, sharp, edges, **options)


def radial(theta, phi, v):
    """Closed form at points of the torus: n.v, kr sin^2, and the view's two components."""
    zero = np.zeros_like(theta)
    n = np.stack([np.cos(phi) * np.cos(theta), np.cos(phi) * np.sin(theta), np.sin(phi)], -1)
    e_phi = np.stack([-np.sin(phi) * np.cos(theta), -np.sin(phi) * np.sin(theta), np.cos(phi)], -1)
    e_theta = np.stack([-np.sin(theta), np.cos(theta), zero], -1)
    u, w = e_phi @ v, e_theta @ v
    k2 = np.cos(phi) / (BIG + SMALL * np.cos(phi))
    return n @ v, u * u / SMALL + w * w * k2, u, w


def along_view(theta, phi, u, w, v):
    """Change of kr sin^2 along the view's tangential part, by central differences."""
    h = 1e-5
    d_theta, d_phi = h * w / (BIG + SMALL * np.cos(phi)), h * u / SMALL
    ahead, behind = (radial(theta + s * d_theta, phi + s * d_phi, v)[1] for s in (1, -1))
    return (ahead - behind) / (2 * h)


def closed_form(v, size, count=900):
    """Suggestive contours from the formula alone: points, strength and n.v."""
    angle = np.linspace(-np.pi, np.pi, count + 1)
    theta, phi = np.meshgrid(angle, angle, indexing="ij")
    lines = find_contours(radial(theta, phi, v)[1], 0.0)
    fine = [interp1d(np.arange(len(q)), q, axis=0)(np.arange(0, len(q) - 1, 0.1)) for q in lines]
    theta, phi = (np.interp(q, np.arange(count + 1), angle) for q in np.concatenate(fine).T)
    facing, _, u, w = radial(theta, phi, v)
    change = along_view(theta, phi, u, w, v) / (u * u + w * w)
    x = np.maximum(change, 0) * size**2 / np.maximum(facing, 1e-12)
    return on_torus(theta, phi), x / (contours.FADE + x), facing


@pytest.mark.parametrize(("tilt", "spin"), [(1.0, 0.3), (1.25, 1.1)])
def test_torus_suggestive_contours_against_closed_form(tilt, spin):
    points, faces = torus(240, 168)
    rotation = turn(tilt, spin)
    # A larger feature size than its own, so that the torus's gentle lines count.
    surface = replace(prepared(points @ rotation.T, faces), size=2.0)
    chains = resample(contours.suggestive(surface), 0.01)
    got = chains.points @ rotation
    truth, strength, facing = closed_form(rotation[2], surface.size)
    bound = 0.005 * (BIG + SMALL)
    drawn = got[chains.strength > LOW]
    assert len(drawn) > 100
    # A line's end moves further than the line: leave room there.
    allowed = (strength > 0.6 * LOW) & (facing > -0.05)
    required = (strength > 1.4 * LOW) & (facing > 0.05)
    off = cKDTree(truth[allowed]).query(drawn)[0]
    assert off.max() < bound, "a false branch"
    missing = cKDTree(drawn).query(truth[required])[0]
    assert missing.max() < bound, "a missing branch"


def test_radial_derivative_against_closed_form():
    m, n = 160, 112
    points, faces = torus(m, n)
    rotation = turn(1.0, 0.3)
    surface = prepared(points @ rotation.T, faces)
    i, j = (q.ravel() for q in np.meshgrid(np.arange(m), np.arange(n), indexing="ij"))
    theta, phi = 2 * np.pi * i / m, 2 * np.pi * j / n
    facing, kr, u, w = radial(theta, phi, rotation[2])
    k1, k2 = 1 / SMALL, np.cos(phi) / (BIG + SMALL * np.cos(phi))
    sine2 = u * u + w * w
    # D_w II(w, w) = C(w, w, w) - 2 n.v |S w|^2, with S the shape operator.
    cubic = along_view(theta, phi, u, w, rotation[2]) + 2 * facing * ((k1 * u) ** 2 + (k2 * w) ** 2)
    want = cubic / sine2 - 2 * facing * ((k2 - k1) * u * w / sine2) ** 2
    steep = sine2 > 0.1
    np.testing.assert_allclose(contours.radial_curvature(surface), kr, atol=5e-3)
    np.testing.assert_allclose(contours.radial_derivative(surface)[steep], want[steep], atol=2e-2)


def test_sphere_contour_is_its_great_circle():
    from scipy.spatial import ConvexHull

    points = np.random.default_rng(5).normal(size=(4000, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    faces = ConvexHull(points).simplices
    a, b, c = (points[faces[:, k]] for k in range(3))
    inward = np.einsum("fn,fn->f", np.cross(b - a, c - a), a) < 0
    faces[inward] = faces[inward][:, ::-1]
    surface = prepared(points, faces)
    chains = contours.contours(surface)
    assert len(chains.begin) == 2
    np.testing.assert_array_equal(chains.points[0], chains.points[-1])
    assert (chains.strength == 1).all()
    assert np.abs(chains.points[:, 2]).max() < 1e-6
    assert np.abs(np.linalg.norm(chains.points[:, :2], axis=1) - 1).max() < 0.005
    around = np.unwrap(np.arctan2(chains.points[:, 1], chains.points[:, 0]))
    assert abs(around[-1] - around[0]) == pytest.approx(2 * np.pi)
    assert (contours.suggestive(surface).strength < LOW).all()


def test_contours_count_only_where_the_surface_bulges():
    points, faces = torus(80, 60)
    rotation = turn(1.2, 0.0)
    surface = prepared(points @ rotation.T, faces)
    chains = contours.contours(surface)
    bulging = contours.radial_curvature(surface) > 0
    assert 0 < bulging.mean() < 1
    nearest = cKDTree(surface.vertices).query(chains.points)[1]
    sure = (chains.strength == 0) | (chains.strength == 1)
    agree = bulging[nearest[sure]] == (chains.strength[sure] == 1)
    assert agree.mean() > 0.95


@pytest.mark.parametrize("kind", ["scale", "shift", "faces", "corners", "vertices"])
def test_lines_do_not_depend_on_how_the_mesh_is_written(kind):
    points, faces = torus(60, 40)
    points = points @ turn(1.0, 0.3).T
    rng = np.random.default_rng(7)
    scale, shift, order = 1.0, np.zeros(3), np.arange(len(points))
    other = faces
    if kind == "scale":
        scale = 37.0
    elif kind == "shift":
        shift = np.array([11.0, -4.0, 90.0])
    elif kind == "faces":
        other = rng.permutation(faces)
    elif kind == "corners":
        other = np.roll(faces, 1, axis=1)
    else:
        order = rng.permutation(len(points))
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        other = place[faces]
    one, two = prepared(points, faces), prepared(scale * points[order] + shift, other)
    for find in (contours.contours, contours.suggestive):
        a, b = find(one), find(two)
        assert len(a.begin) == len(b.begin)
        assert len(a.points) == len(b.points)
        far, at = cKDTree(a.points).query((b.points - shift) / scale)
        assert far.max() < 1e-6
        solid = np.abs(a.strength[at] - b.strength) < 1e-4
        assert solid.mean() > 0.99


def test_crossings_lie_on_edges_where_the_field_vanishes():
    points, faces = torus(24, 16)
    surface = prepared(points @ turn(0.9, 0.2).T, faces)
    field = surface.vertices @ np.array([0.3, 0.5, 0.8]) - 0.1
    chains = contours.zero_set(surface, field, field[None], lambda c: c[0], "contour")
    np.testing.assert_allclose(chains.strength, 0.0, atol=1e-12)
    np.testing.assert_allclose(chains.points @ [0.3, 0.5, 0.8], 0.1, atol=1e-12)
    np.testing.assert_array_equal(
        chains.points[chains.begin[:-1]], chains.points[chains.begin[1:] - 1]
    )


def test_a_field_that_vanishes_on_vertices_still_gives_whole_lines():
    points, faces = torus(24, 16)
    surface = prepared(points, faces)
    field = surface.vertices[:, 2].round(9)
    chains = contours.zero_set(surface, field, field[None], np.ones_like, "contour")
    assert len(chains.begin) == 3
    assert np.isfinite(chains.points).all()


CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
BOX = np.array([[q[0], q[i], q[i + 1]] for q in QUADS for i in (1, 2)])


def test_a_cube_has_twelve_creases_and_no_other_line():
    edges = find_edges(BOX, 8)
    sharp = contours.sharp_edges(CUBE, BOX, edges, 40.0)
    assert sharp.sum() == 12
    np.testing.assert_allclose(np.abs(np.diff(CUBE[edges.ends[sharp]], axis=1)).sum(axis=2), 1.0)
    flipped = BOX.copy()
    flipped[::2] = flipped[::2, ::-1]
    assert (contours.sharp_edges(CUBE, flipped, find_edges(flipped, 8), 40.0) == sharp).all()
    assert contours.lasting_creases(CUBE, edges, sharp, 5.0).sum() == 12
    assert contours.lasting_creases(CUBE, edges, sharp, 13.0).sum() == 0
    surface = contours.prepare(CUBE @ turn(0.7, 0.4).T, BOX, sharp, edges)
    assert len(surface.vertices) == 8 + 24
    assert (contours.suggestive(surface).strength <= LOW).all()


def test_creases_that_end_in_the_open_must_be_long():
    edges = find_edges(BOX, 8)
    sharp = contours.sharp_edges(CUBE, BOX, edges, 40.0)
    one = np.zeros_like(sharp)
    one[np.flatnonzero(sharp)[0]] = True
    assert contours.lasting_creases(CUBE, edges, one, 1 / 12.1).sum() == 1
    assert contours.lasting_creases(CUBE, edges, one, 1 / 11.9).sum() == 0


def test_edge_lines_join():
    square = contours.edge_lines(CUBE, np.array([[0, 1], [3, 1], [3, 2], [2, 0]]), "boundary")
    assert square.begin.tolist() == [0, 5]
    assert (square.strength == 1).all()


def test_the_view_may_differ_from_vertex_to_vertex():
    points, faces = torus(60, 40)
    rotation = turn(1.0, 0.3)
    straight = prepared(points @ rotation.T, faces)
    along = np.broadcast_to(rotation[2], points.shape)
    tilted = prepared(points, faces, view=along)
    np.testing.assert_allclose(
        contours.radial_curvature(straight), contours.radial_curvature(tilted), atol=1e-9
    )
    np.testing.assert_allclose(straight.facing, tilted.facing, atol=1e-12)
