import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.relief.quality.carve import carve, tip_widths


def vee(angle):
    return Cutter("vee", "vee", 6.0, 5.0, 1.0, 500.0, 200.0, 10000.0, angle=angle)


def test_a_slot_narrower_than_the_tip_is_out_of_reach(bench, waves, square):
    slot = -1.0 * ((np.abs(bench.x) < 0.3) & (np.abs(bench.y) < 12))
    wide = Cutter("wide", "flat", 3.0, 5.0, 1.0, 500.0, 200.0, 10000.0)
    pair = bench.pair_of(waves, slot, mask=square)
    found = carve(pair, wide)
    inside = 99 * 139
    assert found.residual == pytest.approx((slot < 0).sum() / inside)
    assert found.beyond == pytest.approx((slot < 0).sum() / inside)


def test_what_the_tip_fits_leaves_nothing(bench, waves, square, finest):
    bowl = 0.05 * (bench.x**2 + bench.y**2)
    h = np.where(bowl < 5, bowl - 5, 0.0)
    found = carve(bench.pair_of(waves, h, mask=square), finest)
    assert found.residual < 1e-3
    assert found.beyond == 0
    assert np.isnan(found.groove_fit)


def test_slopes_inside_and_of_walls(bench, waves, square, finest):
    inside = np.minimum(15 - 2.5 - np.abs(bench.y), 20 - 2.5 - np.abs(bench.x))
    h = np.maximum(-4.0 * np.maximum(inside, 0), -1.9) + 0.1 * np.minimum(bench.x, 10) * (
        inside > 1
    )
    found = carve(bench.pair_of(waves, h, mask=square), finest)
    assert found.slope_inside < 10
    assert 70 < found.slope_walls < 85
    assert found.limit == 90
    assert carve(bench.pair_of(waves, h, mask=square), vee(60.0)).limit == 60


def test_a_groove_is_held_against_the_tip(bench, waves, finest):
    groove = -0.5 * np.maximum(1 - np.abs(bench.x) / 0.75, 0)
    pair = bench.pair_of(waves, groove, strokes=(bench.line(),))
    assert carve(pair, finest).groove_fit == pytest.approx(0.75 / 0.5, rel=0.15)
    assert carve(pair, vee(90.0)).groove_fit == pytest.approx(0.75 / 0.5, rel=0.15)
    assert carve(pair, vee(150.0)).groove_fit < 1


def test_how_wide_a_tip_is(finest):
    np.testing.assert_allclose(tip_widths(vee(90.0), np.array([0.0, 0.5])), [0, 1], atol=0.01)
    np.testing.assert_allclose(tip_widths(finest, np.array([0.25, 3.0])), 0.5, atol=0.01)
