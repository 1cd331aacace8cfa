import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.image.fit import fit_on

GRID = Grid.on_panel((40.0, 30.0), (160, 120))


def disc(shape, radius):
    i, j = np.indices(shape) - np.array(shape)[:, None, None] / 2 + 0.5
    return i**2 + j**2 < radius**2


@pytest.mark.parametrize("radius", [48, 96, 20])
def test_a_figure_is_centred_and_as_large_as_fits(radius):
    fit = fit_on(disc((240, 240), radius), GRID, (40.0, 30.0), margin=3.0)
    rows, cols = np.nonzero(fit.mask(disc((240, 240), radius)))
    x, y = GRID.to_xy(rows + 0.5, cols + 0.5)
    assert np.ptp(y) == pytest.approx(24.0, abs=2 * GRID.pitch)
    assert (x.min() + x.max()) / 2 == pytest.approx(20.0, abs=GRID.pitch)
    assert (y.min() + y.max()) / 2 == pytest.approx(15.0, abs=GRID.pitch)


def test_pixels_that_all_but_fit_are_taken_as_they_are():
    rng = np.random.default_rng(0)
    mask = disc((130, 150), 48)
    values = rng.random(mask.shape)
    fit = fit_on(mask, GRID, (40.0, 30.0), margin=3.0)
    assert fit.ratio == 1.0
    there = fit.mask(mask)
    assert there.sum() == mask.sum()
    np.testing.assert_array_equal(np.sort(fit.field(values, mask)[there]), np.sort(values[mask]))


def test_a_plane_stays_one_at_any_scale():
    i, j = np.indices((300, 300), float)
    mask = disc((300, 300), 140)
    fit = fit_on(mask, GRID, (40.0, 30.0), margin=3.0)
    found = fit.field(2 * i - 3 * j, mask)
    deep = fit.mask(disc((300, 300), 120))
    np.testing.assert_allclose(
        np.diff(found, axis=0)[deep[1:] & deep[:-1]], 2 * fit.ratio, atol=1e-6
    )
    (scale, _, x0), (_, down, y0), _ = fit.matrix
    row, col = np.argwhere(deep)[0]
    x, y = GRID.to_xy(row + 0.5, col + 0.5)
    value = 2 * (y - y0) / down - 3 * (x - x0) / scale
    assert found[row, col] == pytest.approx(value, abs=1e-6)


def test_an_enlarged_picture_shows_no_facets():
    i, j = np.indices((60, 60)) - 29.5
    mask = disc((60, 60), 25)
    fit = fit_on(mask, GRID, (40.0, 30.0), margin=3.0)
    found = fit.field(i**2 + j**2, mask)
    inner = fit.mask(disc((60, 60), 20))
    bend = np.diff(found, 2, axis=0)[inner[1:-1]] / fit.ratio**2
    np.testing.assert_allclose(bend, 2.0, rtol=1e-6)


def test_values_outside_the_mask_take_no_part():
    mask = disc((300, 300), 140)
    values = np.where(mask, 7.0, np.nan)
    fit = fit_on(mask, GRID, (40.0, 30.0), margin=3.0)
    np.testing.assert_allclose(fit.field(values, mask)[fit.mask(mask)], 7.0)


def test_a_margin_must_leave_room():
    with pytest.raises(InputError, match="no room"):
        fit_on(disc((50, 50), 20), GRID, (40.0, 30.0), margin=15.0)
