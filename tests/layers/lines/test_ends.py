import numpy as np

from relieffab.layers.lines.ends import lead_on


def line(start, stop, count=21):
    points = np.linspace(start, stop, count)
    return np.column_stack([points, np.full(count, 0.7)])


WALL = line((10, -5), (10, 5), 201)


def test_an_end_reaches_what_lies_ahead():
    (met,) = lead_on([line((0, 0), (9.5, 0.1))], [WALL], reach=1.0)
    assert len(met) == 22
    assert met[-1, 0] == 10 and abs(met[-1, 1]) < 0.15
    assert met[-1, 2] == 0.7
    np.testing.assert_array_equal(met[0], [0, 0, 0.7])


def test_too_far_beside_or_behind_is_left():
    far, beside, behind = line((0, 0), (8.5, 0)), line((9.2, -9), (9.2, 0)), line((9.5, 0), (3, 0))
    # The first point of the last one has the wall at its back: its other end leads away.
    for one in (far, beside):
        (met,) = lead_on([one], [WALL], reach=1.0)
        assert len(met) == len(one)
    (met,) = lead_on([behind], [WALL], reach=1.0)
    assert len(met) == 22 and met[0, 0] == 10


def test_lines_meet_each_other_but_not_themselves():
    one, two = line((0, 0), (4.6, 0)), line((5, 0), (9, 0))
    met, other = lead_on([one, two], [], reach=1.0)
    # One bridge, not one from each side.
    assert met[-1, 0] == 5.0 and other[0, 0] == 5.0
    assert (len(met), len(other)) == (22, 21)
    ring = np.linspace(0.05, 2 * np.pi - 0.05, 60)
    almost = np.column_stack([5 * np.cos(ring), 5 * np.sin(ring), np.ones(60)])
    (same,) = lead_on([almost], [], reach=1.0)
    assert len(same) == 60


def test_nothing_to_lead():
    assert lead_on([], [WALL], reach=1.0) == []
