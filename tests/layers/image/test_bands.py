import numpy as np
import pytest

from relieffab.layers.image.bands import JUMP, find_bands, flat_share, repair, smoothest


def dome(n=96, levels=40):
    i, j = np.indices((n, n)) - n / 2 + 0.5
    inside = i**2 + j**2 < (0.45 * n) ** 2
    height = 0.5 - ((i**2 + 0.7 * j**2) / n**2)
    return height, np.rint(height * levels * 2) / (levels * 2), inside


def test_banding_is_found_where_it_is():
    _, banded, mask = dome()
    found = find_bands(banded, mask)
    assert found.step == pytest.approx(1 / 80)
    assert found.flat > 0.25
    assert find_bands(dome()[0], mask) is None
    assert find_bands(np.rint(banded * 4) / 4, mask) is None, "few levels are steps that are meant"
    noise = np.random.default_rng(0).integers(0, 256, mask.shape) / 255
    assert find_bands(noise, mask) is None


def test_repair_stays_within_half_a_step_and_takes_the_plateaus_away():
    true, banded, mask = dome()
    smooth, bands = repair(banded, mask)
    assert bands.repaired
    assert np.abs(smooth - banded)[mask].max() <= 0.5 * bands.step + 1e-12
    assert bands.moved <= 0.5 + 1e-9
    assert flat_share(banded, mask, 0.01 * bands.step) > 0.25
    assert flat_share(smooth, mask, 0.01 * bands.step) < 0.06
    assert bands.flat_after < 0.06
    assert len(np.unique(smooth[mask])) > 0.9 * mask.sum()
    before, after = (np.sqrt(((v - true)[mask] ** 2).mean()) for v in (banded, smooth))
    assert after < 0.25 * before
    np.testing.assert_array_equal(smooth[~mask], banded[~mask])


def _energy(d, start, mask, step):
    """Bending of a surface, written out: the plain twin of what the sweeps lessen."""
    total = 0.0
    rows, cols = d.shape
    for i in range(rows):
        for j in range(cols):
            for di, dj in ((0, 1), (1, 0)):
                a, b, c = ((i + k * di, j + k * dj) for k in range(3))
                if c[0] >= rows or c[1] >= cols or not (mask[a] and mask[b] and mask[c]):
                    continue
                if abs(start[a] - 2 * start[b] + start[c]) <= JUMP * step:
                    total += (d[a] - 2 * d[b] + d[c]) ** 2
            if i + 1 < rows and j + 1 < cols and mask[i : i + 2, j : j + 2].all():
                four = [(i, j), (i + 1, j + 1), (i, j + 1), (i + 1, j)]
                s, z = ([v[p] for p in four] for v in (start, d))
                if abs(s[0] + s[1] - s[2] - s[3]) <= JUMP * step:
                    total += 2 * (z[0] + z[1] - z[2] - z[3]) ** 2
    return total


def test_no_small_change_within_the_bounds_bends_it_less():
    _, banded, mask = dome(28, 12)
    step = 1 / 24
    smooth = smoothest(banded, mask, step)
    least = _energy(smooth, banded, mask, step)
    assert least < 0.05 * _energy(banded, banded, mask, step)
    rng = np.random.default_rng(1)
    for _ in range(60):
        i, j = np.argwhere(mask)[rng.integers(mask.sum())]
        other = smooth.copy()
        other[i, j] = np.clip(
            other[i, j] + rng.choice([-1, 1]) * 0.05 * step,
            banded[i, j] - step / 2,
            banded[i, j] + step / 2,
        )
        assert _energy(other, banded, mask, step) >= least * (1 - 1e-3)


def test_a_step_of_the_form_stays():
    _, banded, mask = dome()
    torn = banded + 0.5 * (np.arange(96) >= 48)
    smooth, bands = repair(torn, mask)
    jump = (smooth[:, 48] - smooth[:, 47])[mask[:, 47] & mask[:, 48]]
    assert jump.min() > 0.5 - 1.1 * bands.step
