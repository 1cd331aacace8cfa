import numpy as np

from relieffab.layers.image.inflate import inflate


def test_a_disc_becomes_half_a_ball_and_a_strip_half_a_cylinder():
    i, j = np.indices((400, 400)) - 199.5
    square = i**2 + j**2
    ball = inflate(square < 150**2, 0.1)
    inner = square < 140**2
    want = 0.1 * np.sqrt(np.maximum(150.0**2 - square, 0))
    assert np.abs(ball - want)[inner].max() < 0.05 * 15
    strip = inflate(np.abs(i) < 40, 0.1)[:, 150:250]
    want = 0.1 * np.sqrt(2) * np.sqrt(np.maximum(40.0**2 - i[:, 150:250] ** 2, 0))
    assert np.abs(strip - want)[np.abs(i[:, 150:250]) < 35].max() < 0.08 * 5.7
    assert (ball[square > 152**2] == 0).all()
