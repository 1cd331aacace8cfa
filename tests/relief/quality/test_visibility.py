import numpy as np
import pytest

from relieffab.relief.quality.visibility import contrast, visibility


def grooved(bench, depth=0.4, half=0.5):
    return -depth * np.maximum(1 - np.abs(bench.x) / half, 0) * (np.abs(bench.y) < 13)


def test_a_groove_is_seen_and_counted(bench, waves):
    found = visibility(bench.pair_of(waves, grooved(bench), strokes=(bench.line(),)))
    assert found.median > 0.3
    assert found.grooved == 1


def test_a_ridge_is_no_groove(bench, waves):
    found = visibility(bench.pair_of(waves, -grooved(bench), strokes=(bench.line(),)))
    assert found.grooved == 0


def test_half_the_length(bench, waves):
    half = np.where(bench.y > 0, grooved(bench), 0.0)
    found = visibility(bench.pair_of(waves, half, strokes=(bench.line(),)))
    assert found.grooved == pytest.approx(0.5, abs=0.02)


def test_how_deep_a_groove_has_to_be(bench, waves):
    pair = bench.pair_of(waves, grooved(bench), strokes=(bench.line(),))
    assert visibility(pair, least=0.39).grooved == 1
    assert visibility(pair, least=0.41).grooved == 0


def test_a_flat_relief_shows_nothing(bench, waves):
    found = visibility(bench.pair_of(waves, 0 * waves, strokes=(bench.line(),)))
    assert (found.median, found.worst, found.grooved) == (0, 0, 0)


def test_without_lines_nothing_can_be_said(bench, waves):
    found = visibility(bench.pair_of(waves, waves))
    assert np.isnan([found.median, found.worst, found.grooved]).all()


def test_contrast_is_in_mean_deviations():
    off, on = np.array([4.0, 6.0]), np.array([1.0, 3.0])
    assert contrast(on, off) == pytest.approx(3)
    assert contrast(off, on) == pytest.approx(-3)
    assert contrast(off[:1], off[:1]) == 0
