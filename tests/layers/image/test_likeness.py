import numpy as np
import pytest

from relieffab.layers.image.likeness import DIM, SPREAD, Photograph, energy_of
from relieffab.layers.shading import lambert

ROW, COL = np.indices((9, 11), float)
MASK = (ROW - 4) ** 2 + (COL - 5) ** 2 < 18
WAY = np.array([-0.48, 0.6, 0.64])


def twin(z, photograph):
    """The energy, pixel by pixel as it is written down."""
    normals, total = {}, 0.0
    for i, j in np.argwhere(photograph.mask):
        p = (z[i, j + 1] + z[i + 1, j + 1] - z[i, j] - z[i + 1, j]) / 2
        q = (z[i, j] + z[i, j + 1] - z[i + 1, j] - z[i + 1, j + 1]) / 2
        normals[i, j] = n = np.array([-p, -q, 1.0]) / np.sqrt(1 + p * p + q * q)
        shade, cosine = photograph.shade[i, j], n @ photograph.way
        if cosine <= 0:
            cosine *= np.clip(shade / DIM, 0, 1)
        off = shade - cosine
        total += SPREAD**2 * np.log(1 + off**2 / (2 * SPREAD**2)) + photograph.facing * (1 - n[2])
    for (i, j), n in normals.items():
        for beside in ((i + 1, j), (i, j + 1)):
            if beside in normals:
                total += photograph.bend * ((n - normals[beside]) ** 2).sum()
    return total


@pytest.fixture
def photograph():
    shade = np.random.default_rng(1).uniform(0.0, 1.1, MASK.shape)
    return Photograph(shade, MASK, WAY, facing=0.03, bend=0.05)


def test_the_energy_is_the_formulas(photograph):
    z = np.random.default_rng(2).normal(size=(10, 12))
    assert energy_of(z, photograph)[0] == pytest.approx(twin(z, photograph), rel=1e-12)


def test_its_slope_is_that_of_differences(photograph):
    z = np.random.default_rng(3).normal(size=(10, 12))
    slope = energy_of(z, photograph)[1]
    for i, j in ((0, 0), (3, 4), (5, 6), (4, 9), (7, 5)):
        ahead, behind = z.copy(), z.copy()
        ahead[i, j] += 1e-5
        behind[i, j] -= 1e-5
        want = (twin(ahead, photograph) - twin(behind, photograph)) / 2e-5
        assert slope[i, j] == pytest.approx(want, rel=1e-5, abs=1e-8)


@pytest.mark.parametrize(
    "depth",
    [
        lambda x, y: 0.3 * x - 0.2 * y,
        lambda x, y: np.sqrt(144.0 - x * x),
        lambda x, y: np.sqrt(196.0 - x * x - y * y),
    ],
    ids=["plane", "cylinder", "ball"],
)
def test_a_surface_looks_like_its_own_picture(depth):
    y, x = 4.5 - np.arange(10.0)[:, None], np.arange(12.0) - 5.5
    z = depth(x, y) + 0.0 * y
    p = (z[:-1, 1:] + z[1:, 1:] - z[:-1, :-1] - z[1:, :-1]) / 2
    q = (z[:-1, :-1] + z[:-1, 1:] - z[1:, :-1] - z[1:, 1:]) / 2
    normals = np.stack([-p, -q, np.ones(p.shape)], axis=2) / np.sqrt(1 + p**2 + q**2)[..., None]
    own = Photograph(lambert(normals, WAY[None])[0], MASK, WAY, facing=0.0, bend=0.0)
    energy, slope = energy_of(z, own)
    assert energy == pytest.approx(0.0, abs=1e-20)
    np.testing.assert_allclose(slope, 0.0, atol=1e-12)
    assert energy_of(-z, own)[0] > 1e-4
