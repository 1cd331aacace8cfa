import numpy as np
import pytest

from relieffab.layers.lines.curvature import curvature

BIG, SMALL = 3.0, 1.0


def torus(m=60, n=40):
    """Vertices, faces and both angles; outward-oriented."""
    i, j = np.meshgrid(np.arange(m), np.arange(n), indexing="ij")
    theta, phi = 2 * np.pi * i.ravel() / m, 2 * np.pi * (j.ravel() + 0.5 * (i.ravel() % 2)) / n
    rho = BIG + SMALL * np.cos(phi)
    points = np.stack([rho * np.cos(theta), rho * np.sin(theta), SMALL * np.sin(phi)], axis=1)

    def at(a, b):
        return (a % m) * n + b % n

    even = (i % 2 == 0).ravel()
    i, j = i.ravel(), j.ravel()
    a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
    one = np.where(even[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    two = np.where(even[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return points, np.concatenate([one, two]), theta, phi


def sphere(radius, seed=3, count=600):
    from scipy.spatial import ConvexHull

    points = np.random.default_rng(seed).normal(size=(count, 3))
    points *= radius / np.linalg.norm(points, axis=1, keepdims=True)
    faces = ConvexHull(points).simplices
    a, b, c = (points[faces[:, k]] for k in range(3))
    inward = np.einsum("fn,fn->f", np.cross(b - a, c - a), a) < 0
    faces[inward] = faces[inward][:, ::-1]
    return points, faces


def test_normals_are_exact_on_a_sphere():
    points, faces = sphere(5.0)
    np.testing.assert_allclose(curvature(points, faces).normals, points / 5, atol=1e-9)


def test_sphere_curves_alike_everywhere_and_its_area_is_shared_out():
    points, faces = sphere(5.0)
    bend = curvature(points, faces)
    np.testing.assert_allclose(bend.principal, 0.2, atol=1e-8)
    np.testing.assert_allclose(bend.derivative, 0.0, atol=1e-6)
    a, b, c = (points[faces[:, k]] for k in range(3))
    total = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert bend.areas.sum() == pytest.approx(total)
    assert (bend.areas > 0).all()


def test_torus_against_closed_form():
    points, faces, theta, phi = torus()
    bend = curvature(points, faces)
    k2 = np.cos(phi) / (BIG + SMALL * np.cos(phi))
    assert np.abs(bend.principal[0] - 1 / SMALL).max() < 0.02
    assert np.abs(bend.principal[1] - k2).max() < 0.02
    across = np.stack(
        [-np.sin(phi) * np.cos(theta), -np.sin(phi) * np.sin(theta), np.cos(phi)], axis=1
    )
    sign = np.einsum("vk,vk->v", bend.directions[0], across)
    assert np.abs(np.abs(sign) - 1).max() < 1e-3
    slope = -BIG * np.sin(phi) / (SMALL * (BIG + SMALL * np.cos(phi)) ** 2)
    assert np.abs(bend.derivative[2] * np.sign(sign) - slope).max() < 0.05
    for flat in (0, 1, 3):
        assert np.abs(bend.derivative[flat]).max() < 0.05


def test_frames_are_right_handed_and_orthonormal():
    points, faces, _, _ = torus(30, 20)
    bend = curvature(points, faces)
    e1, e2 = bend.directions
    np.testing.assert_allclose(np.cross(bend.normals, e1), e2, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(e1, axis=1), 1.0, atol=1e-12)
    assert (np.abs(bend.principal[0]) >= np.abs(bend.principal[1])).all()


def face_frames(points, normals, faces, areas):
    """Per triangle: its frame, edges in it, and each corner's turn to the vertex and weight."""
    for corners in faces:
        p = points[corners]
        edges = np.array([p[2] - p[1], p[0] - p[2], p[1] - p[0]])
        up = np.cross(edges[0], edges[1])
        up /= np.linalg.norm(up)
        along = edges[0] / np.linalg.norm(edges[0])
        frame = np.stack([along, np.cross(up, along)])
        turns = [shortest_turn(up, normals[v]) for v in corners]
        weights = [corner_area(p, k) / areas[corners[k]] for k in range(3)]
        yield corners, frame, edges @ frame.T, turns, weights


def rough_torus():
    points, faces, _, _ = torus(12, 9)
    points = points + 0.03 * np.random.default_rng(1).normal(size=points.shape)
    return points, faces, curvature(points, faces)


def test_curvature_agrees_with_a_plain_twin():
    points, faces, bend = rough_torus()
    tensor = np.zeros((len(points), 3, 3))
    frames = face_frames(points, bend.normals, faces, bend.areas)
    for corners, frame, edges, turns, weights in frames:
        n = bend.normals[corners] @ frame.T
        rows, right = [], []
        for k, (u, w) in enumerate(edges):
            rows += [[u, w, 0], [0, u, w]]
            right += list(n[k - 1] - n[k - 2])
        e, f, g = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
        form = frame.T @ np.array([[e, f], [f, g]]) @ frame
        for vertex, turn, weight in zip(corners, turns, weights, strict=True):
            tensor[vertex] += weight * turn @ form @ turn.T
    e1, e2 = bend.directions
    for a, b, want in ((e1, e1, bend.principal[0]), (e2, e2, bend.principal[1]), (e1, e2, 0.0)):
        np.testing.assert_allclose(np.einsum("vi,vij,vj->v", a, tensor, b), want, atol=1e-9)


def test_derivative_agrees_with_a_plain_twin():
    points, faces, bend = rough_torus()
    form = sum(
        k[:, None, None] * e[:, :, None] * e[:, None, :]
        for k, e in zip(bend.principal, bend.directions, strict=True)
    )
    cubic = np.zeros((len(points), 3, 3, 3))
    frames = face_frames(points, bend.normals, faces, bend.areas)
    for corners, frame, edges, turns, weights in frames:
        seen = [
            frame @ turn.T @ form[v] @ turn @ frame.T
            for v, turn in zip(corners, turns, strict=True)
        ]
        rows, right = [], []
        for k, (u, w) in enumerate(edges):
            change = seen[k - 1] - seen[k - 2]
            rows += [[u, w, 0, 0], [0, u, w, 0], [0, u, w, 0], [0, 0, u, w]]
            right += [change[0, 0], change[0, 1], change[1, 0], change[1, 1]]
        c = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
        inplane = np.array([[[c[i + j + k] for k in (0, 1)] for j in (0, 1)] for i in (0, 1)])
        for vertex, turn, weight in zip(corners, turns, weights, strict=True):
            axes = turn @ frame.T
            cubic[vertex] += weight * np.einsum("abc,ia,jb,kc->ijk", inplane, axes, axes, axes)
    e1, e2 = bend.directions
    for a, b, c, want in zip(
        (e1, e1, e1, e2), (e1, e1, e2, e2), (e1, e2, e2, e2), bend.derivative, strict=True
    ):
        got = np.einsum("vijk,vi,vj,vk->v", cubic, a, b, c)
        np.testing.assert_allclose(got, want, atol=1e-8)


def shortest_turn(start, end):
    axis, cosine = np.cross(start, end), start @ end
    cross = np.cross(axis, np.eye(3)).T
    return np.eye(3) + cross + cross @ cross / (1 + cosine)


def corner_area(p, k):
    """Area of the triangle's part that is nearest to corner k."""
    a, b, c = p[k], p[k - 2], p[k - 1]
    u, v = b - a, c - a
    twice = np.linalg.norm(np.cross(u, v))
    w = c - b
    cot_a, cot_b, cot_c = u @ v / twice, -(u @ w) / twice, v @ w / twice
    if min(cot_a, cot_b, cot_c) >= 0:
        return (v @ v * cot_b + u @ u * cot_c) / 8
    if cot_b < 0:
        return u @ u / (8 * cot_a)
    if cot_c < 0:
        return v @ v / (8 * cot_a)
    return twice / 2 - u @ u / (8 * cot_b) - v @ v / (8 * cot_c)


def test_bad_triangles_give_no_nan_and_change_nothing():
    points, faces, _, _ = torus(20, 12)
    clean = curvature(points, faces)
    on_edge = (points[faces[0, 0]] + points[faces[0, 1]]) / 2
    more = np.concatenate([points, [on_edge, [9.0, 9.0, 9.0]]])
    flat = [[faces[0, 0], faces[0, 1], len(points)], [4, 4, 4], [5, 5, 6]]
    bend = curvature(more, np.concatenate([faces, flat]))
    for got, want in zip(bend.principal, clean.principal, strict=True):
        np.testing.assert_allclose(got[:-2], want, atol=1e-12)
    for field in (bend.normals, bend.directions, bend.principal, bend.derivative, bend.areas):
        assert np.isfinite(field).all()
    np.testing.assert_array_equal(bend.principal[:, -2:], 0.0)


def test_doubled_and_opposed_triangles_stay_finite():
    points, faces, _, _ = torus(10, 8)
    doubled = np.concatenate([faces, faces[:20], faces[:, ::-1]])
    bend = curvature(points, doubled)
    for field in (bend.normals, bend.directions, bend.principal, bend.derivative):
        assert np.isfinite(field).all()
    np.testing.assert_allclose(np.linalg.norm(bend.normals, axis=1), 1.0)


def test_no_faces_at_all():
    bend = curvature(np.zeros((4, 3)), np.empty((0, 3), int))
    assert np.isfinite(bend.derivative).all()


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_scale_and_place_do_not_matter(scale):
    points, faces, _, _ = torus(20, 12)
    bend, other = curvature(points, faces), curvature(scale * points + 7 * scale, faces)
    np.testing.assert_allclose(other.principal * scale, bend.principal, atol=1e-9)
    np.testing.assert_allclose(
        np.abs(other.derivative) * scale**2, np.abs(bend.derivative), atol=1e-8
    )
