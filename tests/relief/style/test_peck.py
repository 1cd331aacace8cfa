import numpy as np

from relieffab.relief.style.peck import UNEVEN, pecks


def test_pecks_stand_still_and_differ_a_little_in_depth():
    found = pecks(np.ones((60, 80), bool), 6.0, 0.2, np.random.default_rng(0))
    deep = np.array([one for _, one in found])
    assert (deep[:, 0] == deep[:, 1]).all()
    assert deep.min() >= 0.2 * (1 - UNEVEN) and deep.max() <= 0.2 * (1 + UNEVEN)
    assert np.std(deep) > 0.01
    assert all((place[0] == place[1]).all() for place, _ in found)
