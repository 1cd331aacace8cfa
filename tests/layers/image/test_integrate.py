import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from relieffab.layers.image.integrate import integrate

ROW, COL = np.indices((40, 50), float)
MASK = ((ROW - 20) / 17) ** 2 + ((COL - 25) / 22) ** 2 < 1


def twin(slopes, mask, pitch):
    """The normal equations, put together pixel by pixel and solved directly."""
    number = np.full(mask.shape, -1)
    number[mask] = np.arange(mask.sum())
    rows, cols, data, rhs = [], [], [], []
    for i, j in np.argwhere(mask):
        for di, dj in ((0, 1), (1, 0)):
            k, m = i + di, j + dj
            if k < mask.shape[0] and m < mask.shape[1] and mask[k, m]:
                axis, sign = (0, 1) if dj else (1, -1)
                n = [1 / np.sqrt(1 + (slopes[:, a, b] ** 2).sum()) for a, b in ((i, j), (k, m))]
                mean = slopes[axis, i, j] * n[0] + slopes[axis, k, m] * n[1]
                ask = sign * pitch * mean / sum(n)
                rows += [len(rhs)] * 2
                cols += [number[k, m], number[i, j]]
                data += [1.0, -1.0]
                rhs.append(ask)
    # Nothing tells the mean depth: pin a pixel.
    rows.append(len(rhs))
    cols.append(0)
    data.append(1.0)
    rhs.append(0.0)
    a = coo_array((data, (rows, cols)), shape=(len(rhs), mask.sum())).tocsr()
    out = np.zeros(mask.shape)
    out[mask] = spsolve((a.T @ a).tocsc(), a.T @ np.array(rhs))
    return out


def test_the_direct_solution_is_found():
    slopes = np.random.default_rng(0).normal(size=(2, *MASK.shape))
    found, want = integrate(slopes, MASK, 0.5), twin(slopes, MASK, 0.5)
    want = np.where(MASK, want - want[MASK].max(), 0.0)
    np.testing.assert_allclose(found, want, atol=2e-3 * np.abs(want).max())


@pytest.mark.parametrize("pitch", [0.1, 2.0])
def test_a_surface_comes_back_from_its_slopes(pitch):
    x, y = pitch * (COL - 25), -pitch * (ROW - 20)
    depth = np.sin(x / pitch / 6) * np.cos(y / pitch / 5) * pitch * 4
    slopes = np.stack(
        [
            np.cos(x / pitch / 6) * np.cos(y / pitch / 5) * 4 / 6,
            -np.sin(x / pitch / 6) * np.sin(y / pitch / 5) * 4 / 5,
        ]
    )
    found = integrate(slopes, MASK, pitch)
    off = (found - depth)[MASK]
    assert np.ptp(off) < 0.01 * np.ptp(depth[MASK])
    assert found[MASK].max() == pytest.approx(0.0, abs=1e-12)
    assert (found[~MASK] == 0).all()


def test_parts_that_do_not_touch_are_each_brought_to_the_top():
    mask = MASK & (np.abs(COL - 25) > 2)
    found = integrate(np.ones((2, *MASK.shape)), mask, 1.0)
    for side in (COL < 25, COL > 25):
        assert found[mask & side].max() == pytest.approx(0.0, abs=1e-9)
