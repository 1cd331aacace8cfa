import numpy as np
import pytest

from relieffab.layers.lines.trace import (
    close_gaps,
    drop_short,
    hysteresis,
    narrowed,
    runs,
    seam,
    simplify,
    soften,
)


def flags(text):
    return np.array([c == "#" for c in text])


def text(flags):
    return "".join("#" if f else "." for f in flags)


def test_runs():
    start, stop = runs(flags(".##..#"))
    assert start.tolist() == [1, 5] and stop.tolist() == [3, 6]
    assert [len(r) for r in runs(flags(""))] == [0, 0]


@pytest.mark.parametrize(
    ("before", "closed", "after"),
    [
        ("#..#...#", False, "####...#"),
        ("..#..#..", False, "..####.."),
        (".#...#..", False, ".#...#.."),
        (".#...##.", True, "##...###"),
        ("....", True, "...."),
        ("..####..", True, "..####.."),
    ],
)
def test_gaps_up_to_the_longest_are_closed(before, closed, after):
    assert text(close_gaps(flags(before), 2, closed=closed)) == after


@pytest.mark.parametrize("turn", range(10))
def test_a_loop_is_opened_in_its_longest_gap(turn):
    loop = np.roll(flags("##.###....".replace(" ", "")), turn)
    assert text(np.roll(loop, -seam(loop))) == "..##.###.."
    assert seam(flags("####")) == 0


def test_short_runs_are_dropped():
    assert text(drop_short(flags("##.###.#"), 3)) == "...###.."


def test_hysteresis_keeps_weak_parts_of_strong_lines_only():
    strength = np.array([0.3, 0.6, 0.3, 0.1, 0.3, 0.4, 0.9])
    kept = hysteresis(flags("###.##."), strength, 0.5)
    assert text(kept) == "###...."


def test_narrowing_takes_the_ends_off_within_and_short_stretches_whole():
    assert text(narrowed(flags("#####...#####...##..####"), 1)) == "####.....###.........###"
    assert text(narrowed(flags("####"), 1)) == "####"
    assert not narrowed(flags(".##."), 1).any()


def test_softening_keeps_ends_and_straight_lines():
    line = np.linspace([0.0, 0.0, 1.0], [10.0, 5.0, 1.0], 41)
    np.testing.assert_allclose(soften(line, 3.0, closed=False), line, atol=1e-12)
    noisy = line + 0.1 * np.random.default_rng(0).normal(size=line.shape)
    calm = soften(noisy, 3.0, closed=False)
    np.testing.assert_allclose(calm[[0, -1]], noisy[[0, -1]], atol=1e-12)
    assert np.abs(calm - line)[5:-5].max() < 0.6 * np.abs(noisy - line)[5:-5].max()
    np.testing.assert_array_equal(soften(line[:2], 3.0, closed=False), line[:2])
    assert np.isfinite(soften(noisy[:4], 3.0, closed=False)).all()


def test_softening_a_circle_keeps_it_a_circle():
    angle = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    radius = np.linalg.norm(soften(circle, 3.0, closed=True), axis=1)
    assert np.ptp(radius) < 1e-12 and radius[0] > 0.98


def off_line(points, line):
    """Distance of points to a polyline."""
    a, b = line[:-1], line[1:]
    d = b - a
    t = np.einsum("pnk,nk->pn", points[:, None] - a, d) / np.maximum((d * d).sum(1), 1e-30)
    near = a + np.clip(t, 0, 1)[..., None] * d
    return np.linalg.norm(points[:, None] - near, axis=2).min(axis=1)


@pytest.mark.parametrize("closed", [False, True])
def test_simplified_lines_stay_within_tolerance(closed):
    t = np.linspace(0, 2 * np.pi, 400, endpoint=not closed)
    table = np.stack([3 * np.cos(t), 2 * np.sin(2 * t), t], axis=1)
    out = simplify(table, 0.01, closed=closed)
    assert len(out) < 100
    line = np.concatenate([out, out[:1]]) if closed else out
    assert off_line(table[:, :2], line[:, :2]).max() <= 0.01 + 1e-12
    kept = {tuple(row) for row in table.tolist()}
    assert all(tuple(row) in kept for row in out.tolist())


def test_without_tolerance_only_needless_points_go():
    table = np.array([[0.0, 0, 1], [1, 0, 1], [2, 0, 1], [2, 1, 1]])
    np.testing.assert_array_equal(simplify(table, 0.0, closed=False), table[[0, 2, 3]])
