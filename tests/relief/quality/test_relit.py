import numpy as np
import pytest

from relieffab.layers.shading import light_at
from relieffab.relief.quality.relit import LIGHTS, relit, similarity


def test_lights_stand_where_they_are_said_to():
    np.testing.assert_allclose(light_at(0, 0), [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(light_at(90, 0), [1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(LIGHTS[0], [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(LIGHTS[1], [-0.5, 0.5, np.sqrt(0.5)], atol=1e-12)


def test_the_model_itself_looks_like_itself(bench, waves):
    found = relit(bench.pair_of(waves, waves))
    for value in vars(found).values():
        assert value == pytest.approx(1, abs=1e-6)


def test_an_inverted_relief_looks_inverted_from_the_side_alone(bench, waves):
    found = relit(bench.pair_of(waves, -waves))
    assert found.frontal_ncc == pytest.approx(1, abs=1e-6)
    assert found.oblique_ncc < -0.5
    assert found.inside_ncc < -0.5
    assert found.oblique_ssim < 0


def test_a_flat_relief_tells_nothing(bench, waves):
    found = relit(bench.pair_of(waves, 0 * waves))
    assert found.frontal_ncc == found.oblique_ncc == found.inside_ncc == 0
    assert found.inside_contrast == pytest.approx(0, abs=1e-12)
    assert 0 < found.oblique_ssim < 0.3


def test_a_flat_model_has_nothing_to_tell(bench, waves):
    found = relit(bench.pair_of(0 * waves, waves))
    assert np.isnan(found.frontal_ncc)
    assert np.isnan(found.oblique_ncc)


def test_a_gentler_relief_stays_likely_and_walls_count_apart(bench, waves, square):
    nodes = np.pad(square[:-1, :-1] & square[1:, 1:], 1)
    walled = np.where(nodes, 0.3 * waves - 4.0, 0.0)
    walled[10:12] = walled[-12:-10] = walled[:, 10:12] = walled[:, -12:-10] = 0.0
    walled[12:14, 12:-12] = -1.0
    found = relit(bench.pair_of(waves, walled, mask=square))
    assert found.inside_ncc > 0.9
    assert found.oblique_ncc < found.inside_ncc - 0.1


def test_similarity_is_that_of_scikit_image_in_the_middle():
    metrics = pytest.importorskip("skimage.metrics")
    rng = np.random.default_rng(1)
    a = rng.random((40, 50))
    b = a + 0.3 * rng.normal(size=a.shape)
    b = (b - b.mean()) / b.std() * a.std() + a.mean()
    _, theirs = metrics.structural_similarity(
        a, b, data_range=1.0, gaussian_weights=True, use_sample_covariance=False, full=True
    )
    middle = np.zeros(a.shape, bool)
    middle[5:-5, 5:-5] = True
    whole = similarity(a, b, np.ones(a.shape, bool))
    assert whole == pytest.approx(theirs.mean(), abs=0.02)
    assert whole < 0.9
    assert np.isnan(similarity(a, b, np.zeros(a.shape, bool)))


def test_a_faint_likeness_is_a_likeness_of_little_contrast(bench, waves):
    found = relit(bench.pair_of(waves, 0.01 * waves))
    assert found.inside_ncc > 0.9
    assert 0.005 < found.inside_contrast < 0.05


def test_what_lies_outside_the_figure_takes_no_part(bench, waves, square):
    found = relit(bench.pair_of(waves, waves, mask=square))
    h = waves.copy()
    h[:8] -= 3 * np.arange(8)[::-1, None]
    other = relit(bench.pair_of(waves, h, mask=square))
    assert vars(other) == pytest.approx(vars(found), abs=1e-12)
    assert found.oblique_ssim == pytest.approx(1, abs=1e-6)
