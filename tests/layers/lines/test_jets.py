from dataclasses import replace

import numpy as np
import pytest

from relieffab.layers.lines.curvature import curvature
from relieffab.layers.lines.edges import find_edges
from relieffab.layers.lines.jets import osculate
from relieffab.subject import shapes

BIG, SMALL = 3.0, 1.0


def uneven_torus(m, n, seed=5):
    """A torus with its vertices moved along it; its angles."""
    rng = np.random.default_rng(seed)
    theta = 2 * np.pi * (np.repeat(np.arange(m), n) + rng.uniform(-0.3, 0.3, m * n)) / m
    phi = 2 * np.pi * (np.tile(np.arange(n), m) + rng.uniform(-0.3, 0.3, m * n)) / n
    rho = BIG + SMALL * np.cos(phi)
    points = np.stack([rho * np.cos(theta), rho * np.sin(theta), SMALL * np.sin(phi)], axis=1)
    return points, shapes.torus(BIG, SMALL, (m, n))[1], theta, phi


def measured(points, faces):
    return osculate(points, find_edges(faces, len(points)), curvature(points, faces))


def errors(m, n):
    points, faces, theta, phi = uneven_torus(m, n)
    rough, bend = curvature(points, faces), measured(points, faces)
    normal = np.stack(
        [np.cos(phi) * np.cos(theta), np.cos(phi) * np.sin(theta), np.sin(phi)], axis=1
    )
    k2 = np.cos(phi) / (BIG + SMALL * np.cos(phi))
    slope = -BIG * np.sin(phi) / (SMALL * (BIG + SMALL * np.cos(phi)) ** 2)

    def off(b):
        # C2, the change of k2 along e1, has the sense of e1.
        return [
            np.linalg.norm(b.normals - normal, axis=1).max(),
            np.abs(b.principal - [np.full_like(k2, 1 / SMALL), k2]).max(),
            np.abs(np.abs(b.derivative[2]) - np.abs(slope)).max(),
        ]

    return np.array(off(rough)), np.array(off(bend))


def test_uneven_meshes_converge_where_averages_of_faces_do_not():
    (rough, fine), (rougher, finer) = errors(120, 80), errors(240, 160)
    assert (fine < [3e-3, 0.04, 0.3]).all()
    assert (finer < fine / [5.0, 3.0, 1.5]).all()
    assert (rougher > rough / [2.5, 1.5, 1.0]).all()


def test_a_cubic_is_met_exactly():
    rng = np.random.default_rng(2)

    def surface(u, v):
        x, y = (2 * q - 1 + 0.01 * rng.uniform(-1, 1, len(q)) for q in (u, v))
        height = 0.1 * x - 0.05 * y + 0.3 * x * x - 0.2 * x * y + 0.1 * y * y + 0.1 * x**3
        return np.stack([x, y, height + 0.07 * x * x * y - 0.05 * y**3], axis=1)

    points, faces = shapes.sheet(surface, (30, 30))
    bend = measured(points, faces)
    x, y = points[:, 0], points[:, 1]
    p = 0.1 + 0.6 * x - 0.2 * y + 0.3 * x * x + 0.14 * x * y
    q = -0.05 - 0.2 * x + 0.2 * y + 0.07 * x * x - 0.15 * y * y
    xx, xy, yy = 0.6 + 0.6 * x + 0.14 * y, -0.2 + 0.14 * x, 0.2 - 0.3 * y
    w2 = 1 + p * p + q * q
    mean = -((1 + q * q) * xx - 2 * p * q * xy + (1 + p * p) * yy) / (2 * w2**1.5)
    gauss = (xx * yy - xy**2) / w2**2
    # Over a tilted plane a cubic is one no more, but nearly so on two rings.
    np.testing.assert_allclose(bend.principal.sum(axis=0) / 2, mean, atol=5e-3)
    np.testing.assert_allclose(bend.principal.prod(axis=0), gauss, atol=8e-3)


@pytest.mark.parametrize("degrees", [5, 15, 30])
def test_rough_normals_may_lean(degrees):
    points, faces = shapes.sphere(2.0, 6000)
    rough = curvature(points, faces)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    e1, e2 = rough.directions
    leaning = replace(
        rough,
        normals=c * rough.normals + s * e1,
        directions=np.stack([c * e1 - s * rough.normals, e2]),
    )
    bend = osculate(points, find_edges(faces, len(points)), leaning)
    np.testing.assert_allclose(bend.principal, 0.5, rtol=0.05)
    np.testing.assert_allclose(bend.normals, points / 2, atol=1e-3)
    np.testing.assert_allclose(bend.derivative, 0.0, atol=0.05)


def test_agrees_with_least_squares_at_one_vertex():
    points, faces, _, _ = uneven_torus(40, 30)
    edges, rough = find_edges(faces, len(points)), curvature(points, faces)
    vertex = 617
    ring = {vertex}
    for _ in range(2):
        ring |= {int(b) for a, b in np.r_[edges.ends, edges.ends[:, ::-1]] if a in ring}
    local = points[sorted(ring)] - points[vertex]
    e1, e2 = rough.directions[:, vertex]
    x, y, z = local @ e1, local @ e2, local @ rough.normals[vertex]
    terms = [x**0, x, y, x * x / 2, x * y, y * y / 2]
    terms += [x**3 / 6, x * x * y / 2, x * y * y / 2, y**3 / 6]
    c = np.linalg.lstsq(np.stack(terms, axis=1), z, rcond=None)[0]
    w2 = 1 + c[1] ** 2 + c[2] ** 2
    gauss = (c[3] * c[5] - c[4] ** 2) / w2**2
    bend = osculate(points, edges, rough)
    assert bend.principal[:, vertex].prod() == pytest.approx(gauss, rel=1e-9)


def test_too_few_neighbours_and_folds_keep_the_averages():
    points, faces = shapes.box((1.0, 2.0, 3.0))
    rough = curvature(points, faces)
    bend = osculate(points, find_edges(faces, 8), rough)
    np.testing.assert_array_equal(bend.principal, rough.principal)
    np.testing.assert_array_equal(bend.normals, rough.normals)
    rng = np.random.default_rng(0)
    points, faces, _, _ = uneven_torus(20, 16)
    torn = points + 0.4 * rng.normal(size=points.shape)
    bend = measured(torn, faces)
    for part in (bend.normals, bend.directions, bend.principal, bend.derivative):
        assert np.isfinite(part).all()


def test_rims_are_measured_from_one_side(patch):
    def surface(u, v):
        x, y = 2 * u - 1, 2 * v - 1
        return np.stack([x, y, 0.3 * np.sin(2 * x) * np.cos(1.5 * y)], axis=1)

    points, faces = shapes.sheet(surface, (60, 60))
    bend = measured(points, faces)
    u, v = (q.ravel() for q in np.meshgrid(*[np.linspace(0, 1, 60)] * 2, indexing="ij"))
    (e, f, g), (uu, uv, vv), *_ = patch(surface).forms(u, v)
    gauss = (uu * vv - uv**2) / (e * g - f * f)
    np.testing.assert_allclose(bend.principal.prod(axis=0), gauss, atol=0.05)
