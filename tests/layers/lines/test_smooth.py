import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.linalg import spsolve

from relieffab.errors import InputError
from relieffab.layers.lines import smooth as module
from relieffab.layers.lines.smooth import laplacian, smooth
from relieffab.subject import shapes


def rippled(wavelength, pitch=0.05, count=64):
    """A periodic-looking sheet with ripples along X, height 0.01."""
    x, y = np.meshgrid(pitch * np.arange(count), pitch * np.arange(count))
    z = 0.01 * np.cos(2 * np.pi * x / wavelength)
    points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    at = np.arange(count * count).reshape(count, count)
    a, b, c, d = (q.ravel() for q in (at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]))
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]), (x, y, z)


@pytest.mark.parametrize(("wavelength", "left"), [(0.8, 0.5), (0.4, 1 / 17), (1.6, 16 / 17)])
def test_a_ripple_as_long_as_detail_keeps_half_its_height(wavelength, left):
    points, faces, (x, _, z) = rippled(wavelength)
    out = smooth(points, faces, detail=0.8)[:, 2].reshape(z.shape)
    inside = (slice(24, -24), slice(24, -24))
    wave = np.cos(2 * np.pi * x / wavelength)[inside]
    ratio = (out[inside] * wave).sum() / (z[inside] * wave).sum()
    assert ratio == pytest.approx(left, abs=0.04)


def test_nothing_moves_without_detail_and_input_stays():
    points, faces, _ = rippled(0.4)
    before = points.copy()
    np.testing.assert_array_equal(smooth(points, faces, detail=0.0), points)
    smooth(points, faces, detail=1.0)
    np.testing.assert_array_equal(points, before)


def test_place_does_not_matter():
    points, faces, _ = rippled(0.4)
    shift = np.array([100.0, -50.0, 7.0])
    moved = smooth(points + shift, faces, detail=0.5) - shift
    np.testing.assert_allclose(moved, smooth(points, faces, detail=0.5), atol=1e-6)


def test_agrees_with_a_direct_solution():
    points, faces, _ = rippled(0.3, count=20)
    points = points + 0.02 * np.random.default_rng(2).normal(size=points.shape)
    matrix, areas = laplacian(points, faces)
    assert matrix.diagonal().min() >= 0
    assert (matrix - sparse.diags(matrix.diagonal())).max() <= 0
    # Inside: (M + t^2 L M^-1 L) x = M x, real and of fourth order.
    step = (0.5 / (2 * np.pi)) ** 2
    system = sparse.diags(areas) + step**2 * matrix @ sparse.diags(1 / areas) @ matrix
    want = spsolve(system.tocsc(), areas[:, None] * points)
    np.testing.assert_allclose(smooth(points, faces, detail=0.5), want, atol=5e-4)


def whirl(rings=120, around=48):
    """A rippled disc whose triangles grow a thousandfold from its middle, long ones between."""
    r = np.geomspace(1e-3, 1.0, rings)[:, None]
    t = 2 * np.pi * np.arange(around) / around + 0.1 * np.arange(rings)[:, None]
    z = 0.03 * r * np.cos(7 * t + 20 * r)
    points = np.stack([r * np.cos(t), r * np.sin(t), z], axis=2).reshape(-1, 3)
    at = np.arange(rings * around).reshape(rings, around)
    a, d = at[:-1].ravel(), at[1:].ravel()
    b, c = (np.roll(q, -1, axis=1).ravel() for q in (at[:-1], at[1:]))
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def test_uneven_triangles_cost_few_steps_and_no_accuracy(monkeypatch):
    points, faces = whirl()
    matrix, areas = laplacian(points, faces)
    step = (0.5 / (2 * np.pi)) ** 2
    assert (step * matrix.diagonal() / areas).max() > 1e4
    system = (sparse.diags(areas) + 1j * step * matrix).tocsc()
    want = points + spsolve(system, step * (matrix @ points)).imag
    monkeypatch.setattr(module, "MOST_STEPS", 30)
    np.testing.assert_allclose(smooth(points, faces, detail=0.5), want, atol=5e-4)


def test_loose_vertices_and_flat_triangles_stay_where_they_are():
    points, faces, _ = rippled(0.4, count=10)
    points = np.concatenate([points, [[5.0, 5.0, 5.0]]])
    faces = np.concatenate([faces, [[3, 3, 3], [0, 1, 1]]])
    out = smooth(points, faces, detail=1.0)
    assert np.isfinite(out).all()
    np.testing.assert_array_equal(out[-1], points[-1])


def test_says_so_when_it_does_not_converge(monkeypatch):
    monkeypatch.setattr(module, "MOST_STEPS", 1)
    points, faces, _ = rippled(0.4)
    with pytest.raises(InputError, match="cannot be smoothed"):
        smooth(points, faces, detail=5.0)


def volume(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.einsum("fn,fn->", a, np.cross(b, c)) / 6


def test_volume_stays():
    points, faces = shapes.torus(12.0, 3.0, (160, 60))
    before, after = volume(points, faces), volume(smooth(points, faces, detail=2.0), faces)
    assert after == pytest.approx(before, rel=1e-3)
    # One step of heat flow, as strong at that wavelength, loses forty times as much.
    matrix, areas = laplacian(points, faces)
    heat = sparse.diags(areas) + (2.0 / (2 * np.pi)) ** 2 * matrix
    melted = spsolve(heat.tocsc(), areas[:, None] * points)
    assert before - volume(melted, faces) > 40 * abs(before - after)


def test_a_flat_sheet_keeps_its_rim():
    points, faces, _ = rippled(0.4, count=20)
    points[:, 2] = 0.0
    rim = np.zeros((20, 20), bool)
    rim[[0, -1]] = rim[:, [0, -1]] = True
    free = smooth(points, faces, detail=0.8)
    held = smooth(points, faces, detail=0.8, rim=rim.ravel())
    assert np.abs(free - points).max() > 0.01
    np.testing.assert_allclose(held, points, atol=1e-9)
