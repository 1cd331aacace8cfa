import json

import pytest

from relieffab.relief.quality.measure import measure


@pytest.fixture
def itself(bench, waves, finest):
    """The model measured against itself, without lines."""
    pair = bench.pair_of(waves, waves)
    return measure(pair.relief, pair.layers, finest)


def test_the_model_itself_is_without_fault(itself):
    assert itself.relit.oblique_ncc == pytest.approx(1)
    assert itself.order.local == 1
    assert itself.detail.s4 == pytest.approx(1)
    assert itself.border.outside == 0


def test_all_of_it_is_plain_json_and_what_has_no_meaning_is_none(itself):
    figures = itself.as_dict()
    assert json.loads(json.dumps(figures, allow_nan=False)) == figures
    assert figures["visibility"] == {"median": None, "worst": None, "grooved": None}
    assert sorted(figures) == sorted(
        ["relit", "angle", "order", "visibility", "use", "detail", "carve", "border"]
    )
    assert all(
        value is None or type(value) is float
        for part in figures.values()
        for value in part.values()
    )


def test_a_real_surface_and_its_layers(layers, finest):
    """Linear compression of a rendered model: nearly the model, all but for the scale."""
    import numpy as np

    from relieffab.relief.model import Relief

    mask, depth = layers.mask, layers.depth
    wide = [np.pad(depth, ((a, 1 - a), (b, 1 - b))) for a in (0, 1) for b in (0, 1)]
    count = sum(np.pad(mask * 1.0, ((a, 1 - a), (b, 1 - b))) for a in (0, 1) for b in (0, 1))
    h = sum(wide) / np.maximum(count, 1)
    low, high = h[count > 0].min(), h[count > 0].max()
    h = np.where(count > 0, (h - high) / (high - low) * 2.0, 0.0)
    found = measure(Relief(layers.grid, h, mask, 2.0), layers, finest)
    assert found.angle.gradient < 10
    assert found.order.local > 0.98
    assert found.relit.inside_ncc > 0.8
    assert found.angle.scale == pytest.approx((high - low) / 2.0, rel=0.1)
