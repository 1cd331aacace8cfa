from dataclasses import replace

import numpy as np
import pytest

from relieffab.relief.style.hatch import DARK, LIGHT, darkness


def test_shadows_are_dark_and_lights_bare(ball):
    layers = ball.layers
    dark = darkness(layers, 0.3)
    tone = layers.shading.mean(axis=0)
    low, high = np.percentile(tone[layers.mask], (DARK, LIGHT))
    for place in ((40, 120), (90, 120), (150, 120), (140, 70)):
        want = np.clip((high - tone[place]) / (high - low), 0, 1)
        assert dark[place] == pytest.approx(want, abs=0.06)
    assert dark.min() == 0 and dark.max() == 1


def test_an_even_tone_is_hatched_all_over(level):
    even = replace(level.layers, shading=0.5 * np.ones_like(level.layers.shading))
    assert (darkness(even, 0.5) == 1).all()
