from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from relieffab.layers.lines import contours
from relieffab.layers.lines.chains import resample
from relieffab.layers.lines.surface import FEATURE, bounding_radius
from relieffab.subject import shapes

BIG, SMALL = 3.0, 1.2
LOW = 0.25
LARGE = 2.0
"""A larger feature size than the models' own, so that their gentle lines count."""


def torus(u, v):
    theta, phi = 2 * np.pi * u, 2 * np.pi * v
    rho = BIG + SMALL * np.cos(phi)
    return np.stack([rho * np.cos(theta), rho * np.sin(theta), SMALL * np.sin(phi)], axis=1)


def saddle(u, v):
    """A monkey saddle; a plain one, z = xy, has lines of no strength."""
    x, y = 4 * u - 2, 4 * v - 2
    return np.stack([x, y, 0.12 * (x**3 - 3 * x * y * y)], axis=1)


SURFACES = {"torus": (torus, (240, 168), True), "saddle": (saddle, (200, 200), False)}


def uneven(surface, counts, closed, amount=0.3):
    """The same surface with its vertices moved along it by a share of their distance."""
    rng = np.random.default_rng(11)

    def moved(u, v):
        free = np.ones(len(u)) if closed else (u > 0) * (u < 1) * (v > 0) * (v < 1)
        return surface(
            *(
                q + free * rng.uniform(-amount, amount, len(u)) / n
                for q, n in zip((u, v), counts, strict=True)
            )
        )

    return moved


def case(prepared, name, turn, scale=1.0, jitter=0.0):
    surface, counts, closed = SURFACES[name]
    counts = tuple(int(scale * n) for n in counts)
    shape = uneven(surface, counts, closed, jitter)
    vertices, faces = shapes.sheet(shape, counts, closed=(closed, closed))
    return replace(prepared(vertices @ turn.T, faces), radius=LARGE / FEATURE)


def off(of, lines):
    """Distances as seen."""
    return cKDTree(lines[:, :2]).query(of[:, :2])[0]


@pytest.mark.parametrize("jitter", [0.0, 0.3])
@pytest.mark.parametrize(("tilt", "spin"), [(1.0, 0.3), (1.25, 1.1), (0.6, 0.2)])
@pytest.mark.parametrize("name", ["torus", "saddle"])
def test_lines_against_closed_form(patch, prepared, rotation, name, tilt, spin, jitter):
    turn = rotation(tilt, spin)
    surface = case(prepared, name, turn, jitter=jitter)
    assert 39_000 < len(surface.vertices) < 41_000
    bound = 0.005 * bounding_radius(surface.vertices)
    form = patch(SURFACES[name][0])

    truth, kr = form.contours(turn[2])
    closed = SURFACES[name][2]
    if not closed:  # the inside may be seen
        kr = np.abs(kr)
    lines = resample(contours.contours(surface), 0.01)
    drawn, truth = lines.points[lines.strength > 0.5], truth @ turn.T
    assert off(drawn, truth[kr > -0.02]).max() < bound, "a false contour"
    assert off(truth[kr > 0.02], drawn).max() < bound, "a missing contour"

    truth, strength, facing = form.suggestive(turn[2], LARGE)
    facing = facing if closed else np.abs(facing)
    lines = resample(contours.suggestive(surface), 0.01)
    drawn, truth = lines.points[lines.strength > LOW], truth @ turn.T
    # A line's end moves further than the line: leave room there, where its
    # strength is about the least, and at cusps, where it passes behind.
    near = ((strength > 0.4 * LOW) & (facing > -0.05)) | (np.abs(facing) < 0.05)
    # Where two branches all but touch, their tip is at the mercy of single triangles.
    share = 98 if jitter else 100
    assert len(drawn) == 0 or np.percentile(off(drawn, truth[near]), share) < bound, "a false line"
    assert len(drawn) == 0 or off(drawn, truth[near]).max() < 3 * bound, "a false line"
    sure = (strength > 1.6 * LOW) & (facing > 0.05)
    assert not sure.any() or off(truth[sure], drawn).max() < bound, "a missing line"


@pytest.mark.parametrize("jitter", [0.0, 0.3])
def test_lines_converge_with_refinement(patch, prepared, rotation, jitter):
    turn = rotation(0.6, 0.2)
    truth = patch(torus).suggestive(turn[2], LARGE)[0] @ turn.T
    far = []
    for scale in (0.5, 1.0, 2.0):
        lines = resample(contours.suggestive(case(prepared, "torus", turn, scale, jitter)), 0.01)
        drawn = lines.points[(lines.strength > 0.5)]
        far.append(np.percentile(off(drawn, truth), 95))
    assert far[1] < 0.4 * far[0] and far[2] < 0.4 * far[1]


def test_radial_curvature_and_its_derivative_against_closed_form(patch, prepared, rotation):
    turn = rotation(1.0, 0.3)
    vertices, faces = shapes.torus(BIG, SMALL, (160, 112))
    surface = prepared(vertices @ turn.T, faces)
    i, j = (q.ravel() for q in np.meshgrid(np.arange(160), np.arange(112), indexing="ij"))
    u, v, form, h = i / 160, j / 112, patch(torus), 1e-4
    facing, kr, du, dv = form.radial(u, v, turn[2])
    ahead, behind = (form.radial(u + s * h * du, v + s * h * dv, turn[2])[1] for s in (1, -1))
    # D_w II(w, w) = C(w, w, w) - 2 n.v |S w|^2, with S the shape operator.
    x, y = 2 * np.pi * SMALL * dv, 2 * np.pi * (BIG + SMALL * np.cos(2 * np.pi * v)) * du
    k1, k2 = 1 / SMALL, np.cos(2 * np.pi * v) / (BIG + SMALL * np.cos(2 * np.pi * v))
    sine2 = 1 - facing**2
    cubic = (ahead - behind) / (2 * h) + 2 * facing * ((k1 * x) ** 2 + (k2 * y) ** 2)
    want = cubic / sine2 - 2 * facing * ((k2 - k1) * x * y / sine2) ** 2
    steep = sine2 > 0.1
    np.testing.assert_allclose(contours.radial_curvature(surface), kr, atol=5e-3)
    np.testing.assert_allclose(contours.radial_derivative(surface)[steep], want[steep], atol=2e-2)


def test_sphere_contour_is_its_great_circle(prepared):
    surface = prepared(*shapes.sphere(1.0, 4000))
    chains = contours.contours(surface)
    assert len(chains.begin) == 2
    np.testing.assert_array_equal(chains.points[0], chains.points[-1])
    assert (chains.strength == 1).all()
    assert np.abs(np.linalg.norm(chains.points[:, :2], axis=1) - 1).max() < 0.005
    around = np.unwrap(np.arctan2(chains.points[:, 1], chains.points[:, 0]))
    assert abs(around[-1] - around[0]) == pytest.approx(2 * np.pi)
    assert (contours.suggestive(surface).strength < LOW).all()


@pytest.mark.parametrize("seed", range(6))
def test_a_plane_seen_edge_on_has_no_contour(prepared, rotation, seed):
    # A flat wall of many triangles, edge on but for rounding, there and back.
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    vertices, faces = shapes.sheet(
        lambda u, v: np.stack([u, 0 * u, v + 0.01 * rng.normal(size=len(v))], axis=1), (9, 9)
    )
    surface = prepared(vertices @ turn.T @ turn, faces)
    assert np.abs(contours.radial_curvature(surface)).max() < 1e-9
    assert (contours.contours(surface).strength == 0).all()


def test_contours_count_only_where_the_surface_bulges(prepared, rotation):
    vertices, faces = shapes.torus(BIG, SMALL, (80, 60))
    surface = prepared(vertices @ rotation(1.2, 0.0).T, faces)
    chains = contours.contours(surface)
    bulging = contours.radial_curvature(surface) > 0
    assert 0 < bulging.mean() < 1
    nearest = cKDTree(surface.vertices).query(chains.points)[1]
    agree = bulging[nearest] == (chains.strength == 1)
    assert agree.mean() > 0.95


@pytest.mark.parametrize("kind", ["scale", "shift", "faces", "corners", "vertices"])
def test_lines_do_not_depend_on_how_the_mesh_is_written(prepared, rotation, kind):
    points, faces = shapes.torus(BIG, SMALL, (60, 40))
    points = points @ rotation(1.0, 0.3).T
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


def test_strength_fades_from_one_half_to_a_quarter_at_the_least():
    np.testing.assert_allclose(
        contours.fading(np.array([-1.0, 0.0, 0.01, 0.03]), 0.01), [0, 0, 0.25, 0.5]
    )
