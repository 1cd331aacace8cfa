import numpy as np
from scipy.optimize import minimize

from relieffab.layers.image.likeness import Photograph, energy_of
from relieffab.layers.image.settle import settle
from relieffab.layers.shading import lambert

WAY = np.array([-0.48, 0.6, 0.64])
ROW, COL = np.indices((14, 17), float)
MASK = (ROW - 6.5) ** 2 / 36 + (COL - 8) ** 2 / 49 < 1


def photograph():
    p, q = 0.5 * np.sin(COL / 3), 0.4 * np.cos(ROW / 3)
    normals = np.stack([-p, -q, np.ones(p.shape)], axis=2) / np.sqrt(1 + p**2 + q**2)[..., None]
    return Photograph(lambert(normals, WAY[None])[0], MASK, WAY, facing=0.002, bend=0.01)


def test_the_minimum_is_the_one_of_a_general_method():
    seen, flat, hold = photograph(), np.zeros((15, 18)), 0.01
    held = np.zeros(flat.shape, bool)
    for i, j in np.argwhere(MASK):
        held[i : i + 2, j : j + 2] = True

    def value(y):
        z = y.reshape(flat.shape)
        energy, slope = energy_of(z, seen)
        return energy + 0.5 * hold * (z[held] ** 2).sum(), (slope + hold * held * z).ravel()

    options = {"maxiter": 5000, "ftol": 1e-15, "gtol": 1e-10}
    want = minimize(value, flat.ravel(), jac=True, method="L-BFGS-B", options=options)
    found = settle(flat, seen, 500, reference=flat, hold=hold)
    assert value(found.ravel())[0] < want.fun * (1 + 1e-3)
    off = np.abs(found - want.x.reshape(flat.shape))[held]
    assert off.max() < 0.1 * np.ptp(want.x)


def test_every_step_gains():
    seen, flat = photograph(), np.zeros((15, 18))
    left = [energy_of(settle(flat, seen, k, reference=flat, hold=0.0), seen)[0] for k in range(8)]
    assert left[0] == energy_of(flat, seen)[0]
    assert (np.diff(left) < 0).all()
