from itertools import pairwise

import numpy as np

from relieffab.layers.lines.chains import Chains, join, resample


def walks(segments):
    order, begin = join(np.array(segments).reshape(-1, 2))
    return sorted(order[a:b].tolist() for a, b in pairwise(begin))


def test_an_open_chain_in_any_order():
    assert walks([[7, 3], [9, 7], [3, 1]]) in ([[1, 3, 7, 9]], [[9, 7, 3, 1]])


def test_a_loop_ends_where_it_begins():
    (loop,) = walks([[4, 2], [2, 8], [8, 4]])
    assert loop[0] == loop[-1] and sorted(loop[:-1]) == [2, 4, 8]


def test_branches_part_at_the_junction_and_each_segment_counts_once():
    chains = walks([[0, 1], [1, 2], [2, 3], [2, 4], [2, 1]])
    joined = {tuple(sorted(c[i : i + 2])) for c in chains for i in range(len(c) - 1)}
    assert joined == {(0, 1), (1, 2), (2, 3), (2, 4)}
    assert sum(len(c) - 1 for c in chains) == 4 and len(chains) == 3


def test_nothing_to_join():
    order, begin = join(np.empty((0, 2), int))
    assert len(order) == 0 and begin.tolist() == [0]


def test_random_graph_keeps_every_segment_exactly_once():
    pairs = np.random.default_rng(0).integers(0, 40, (60, 2))
    chains = walks(pairs)
    want = {tuple(sorted(p)) for p in pairs.tolist() if p[0] != p[1]}
    got = [tuple(sorted(c[i : i + 2])) for c in chains for i in range(len(c) - 1)]
    assert sorted(got) == sorted(want)


def chains_of(points, begin):
    points = np.asarray(points, float)
    n = len(points)
    return Chains(points, points[:, 0].copy(), np.ones((n, 3)), np.ones(n), np.array(begin))


def test_resampled_points_lie_evenly_on_each_line():
    points = [[0, 0, 0], [1, 0, 2], [1, 3, 2], [50, 50, 0], [50, 52, 0]]
    fine = resample(chains_of(points, [0, 3, 5]), 0.5)
    assert fine.begin.tolist() == [0, 9, 14]
    np.testing.assert_allclose(fine.points[[0, 8, 9, 13]], np.array(points)[[0, 2, 3, 4]])
    np.testing.assert_allclose(fine.points[2], [1, 0, 2])
    gaps = np.linalg.norm(np.diff(fine.points[:9, :2], axis=0), axis=1)
    np.testing.assert_allclose(gaps, 0.5)
    np.testing.assert_allclose(fine.strength, fine.points[:, 0])


def test_resampling_nothing():
    assert len(resample(chains_of(np.empty((0, 3)), [0]), 0.5).points) == 0
