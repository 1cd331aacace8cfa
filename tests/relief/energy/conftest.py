"""Small lattices with nothing in them that is even."""

import numpy as np
import pytest

from relieffab.layers.shading import default_lights
from relieffab.relief.energy.terms import Terms, Weights
from relieffab.relief.model import nodes_of

PITCH = 0.3
WEIGHTS = Weights(depth=1.0, line=2.0, twist=0.3, light=0.7, form=0.2)


def random_terms(shape=(24, 26), seed=0, **changes):
    """Terms of random numbers: a figure with holes, some pixels occluded, some nodes not whole."""
    rng = np.random.default_rng(seed)
    pixels = (shape[0] - 1, shape[1] - 1)
    inside = np.zeros(pixels, bool)
    inside[3:-3, 3:-4] = rng.random((pixels[0] - 6, pixels[1] - 7)) > 0.05
    inside[3:6, 3:7] = False
    figure = nodes_of(inside)
    whole = rng.random(shape) > 0.1
    whole[0] = whole[-1] = whole[:, 0] = whole[:, -1] = False
    for i in (slice(None, -1), slice(1, None)):
        for j in (slice(None, -1), slice(1, None)):
            whole[i, j] &= inside
    singles = {
        "stencil": rng.random(pixels) * inside,
        "slope": rng.normal(size=(2, *pixels)),
        "radiance": rng.random((2, *pixels)),
        "form": rng.normal(size=shape) * figure,
    }
    given = {
        "pitch": PITCH,
        "lights": default_lights(),
        "weights": WEIGHTS,
        "mask": inside & (rng.random(pixels) > 0.05),
        "whole": whole,
        "figure": figure,
        "bounds": (-np.inf, np.inf),
        **{name: array.astype(np.float32) for name, array in singles.items()},
    }
    return Terms(**{**given, **changes})


def random_heights(terms, seed=1, size=0.2):
    """Heights on the figure."""
    rng = np.random.default_rng(seed)
    return size * rng.normal(size=terms.figure.shape) * terms.figure


def dense(apply, free):
    """The matrix that a product with unit vectors gives, of free nodes alone."""
    nodes = np.argwhere(free)
    matrix = np.zeros((len(nodes), len(nodes)))
    for k, (i, j) in enumerate(nodes):
        unit, out = np.zeros((2, *free.shape))
        unit[i, j] = 1
        apply(unit, free, out)
        matrix[:, k] = out[free]
    return matrix


@pytest.fixture
def make_terms():
    return random_terms


@pytest.fixture
def make_heights():
    return random_heights


@pytest.fixture
def dense_of():
    return dense


@pytest.fixture
def terms():
    return random_terms()


@pytest.fixture
def h(terms):
    return random_heights(terms)
