from itertools import permutations, product

import numpy as np
import pytest

from relieffab.toolpath.order import arrange

REACH, SHARE = 4.0, 0.5


def cost(runs, start, order, turned):
    """What the ways between runs cost, added up one by one."""
    total, here = 0.0, start
    for k, back in zip(order, turned, strict=True):
        run = runs[k][::-1] if back else runs[k]
        away = float(np.hypot(*(run[0] - here)))
        total += min(away, REACH) + SHARE * max(away - REACH, 0.0)
        here = run[-1]
    return total


def least(runs, start):
    """Of all orders and directions, the cheapest."""
    count = len(runs)
    ways = product(permutations(range(count)), product((False, True), repeat=count))
    return min(cost(runs, start, order, turned) for order, turned in ways)


def test_order_goes_to_the_nearest_end():
    runs = [np.array([[x, 0.0], [x, 9.0]]) for x in (0.0, 2.0, 1.0)]
    assert arrange(runs, np.zeros(2)) == ([0, 2, 1], [False, True, False])
    assert arrange([], np.zeros(2)) == ([], [])


@pytest.mark.parametrize("seed", range(12))
def test_five_runs_come_in_the_cheapest_order_or_nearly(seed):
    rng = np.random.default_rng(seed)
    runs = list(rng.uniform(0, 20, (5, 1, 2)) + rng.uniform(-4, 4, (5, 2, 2)))
    found = arrange(runs, np.zeros(2), reach=REACH, share=SHARE)
    assert sorted(found[0]) == list(range(5))
    assert cost(runs, np.zeros(2), *found) <= 1.1 * least(runs, np.zeros(2)) + 1e-9


def test_no_run_is_left_behind_to_be_fetched_at_the_end():
    """The nearest each time leaves out one in a row, and comes back for it."""
    at = [1.0, 2.2, -1.5, 5.0, 9.5, 14.0]
    runs = [np.array([[x, 0.0], [x, 0.1]]) for x in at]
    order, _ = arrange(runs, np.zeros(2))
    assert order == [2, 0, 1, 3, 4, 5]


def test_many_runs_cost_much_less_than_the_nearest_each_time():
    rng = np.random.default_rng(7)
    ends = rng.uniform(0, 100, (400, 1, 2)) + rng.uniform(-2, 2, (400, 2, 2))
    runs, here, left = list(ends), np.zeros(2), set(range(400))
    order, turned = [], []
    while left:
        away = {(k, s): np.hypot(*(ends[k, s] - here)) for k in left for s in (0, 1)}
        k, side = min(away, key=away.get)
        order, turned, here = [*order, k], [*turned, side == 1], ends[k, 1 - side]
        left.discard(k)
    found = arrange(runs, np.zeros(2), reach=REACH, share=SHARE)
    assert sorted(found[0]) == list(range(400))
    assert cost(runs, np.zeros(2), *found) < 0.9 * cost(runs, np.zeros(2), order, turned)
