import numpy as np
import pytest

from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.kinds import KINDS
from relieffab.layers.lines.tidy import Line, Rules, tidy
from relieffab.layers.lines.trace import length

STEP = 0.1
KIND = {kind.name: kind for kind in KINDS}


def rules(kind="suggestive"):
    return Rules.of(KIND[kind], Drawing(), STEP)


def chain(points, strength=1.0):
    points = np.asarray(points, float)
    n = len(points)
    table = np.column_stack([points, np.zeros(n)])
    strength = np.broadcast_to(strength, n).astype(float)
    return Chains(table, strength, np.tile([0.0, 0, 1], (n, 1)), np.zeros(n), np.array([0, n]))


def straight(span, at=0.0):
    x = np.arange(0, span + 1e-9, STEP)
    return np.stack([x, np.full_like(x, at)], axis=1)


def ring(radius=5.0, count=314):
    angle = 2 * np.pi * np.arange(count) / count
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def drawn(chains, keep=None, before=(), kind="suggestive"):
    keep = np.ones(len(chains.points), bool) if keep is None else keep
    return tidy(kind, chains, keep, before, rules(kind))


def test_short_hidden_gaps_and_short_faint_ones_are_closed():
    line = straight(20.0)
    keep, strength = np.ones(201, bool), np.ones(201)
    keep[50:55] = False  # half a millimetre
    strength[120:132] = 0.0  # a little more than one
    (whole,) = drawn(chain(line, strength), keep)
    assert length(whole.table) == pytest.approx(20.0)
    assert whole.table[:, 2].min() >= 0.25
    keep[50:60] = False
    assert len(drawn(chain(line, strength), keep)) == 2
    keep[50:60] = True
    strength[120:150] = 0.0
    assert len(drawn(chain(line, strength), keep)) == 2


def test_a_line_must_be_strong_somewhere():
    line = straight(20.0)
    assert drawn(chain(line, 0.45)) == []
    assert len(drawn(chain(line, np.linspace(0.3, 0.6, 201)))) == 1
    assert drawn(chain(line, 0.45), kind="contour") == []


@pytest.mark.parametrize("turn", [0, 40, 100, 157, 230, 300])
def test_a_loop_is_cut_the_same_wherever_it_starts(turn):
    points = np.roll(ring(), -turn, axis=0)
    strength = np.ones(314)
    strength[100:140] = 0.0  # too long to close
    keep = np.ones(314, bool)
    keep[200:204] = False  # short enough
    strength, keep = np.roll(strength, -turn), np.roll(keep, -turn)
    looped = chain(np.concatenate([points, points[:1]]), np.append(strength, strength[0]))
    (line,) = drawn(looped, np.append(keep, keep[0]))
    assert not line.closed
    # The ring less its gap; softened, a line fades half a deviation early.
    assert length(line.table) == pytest.approx(0.1 * (314 - 40), abs=0.8)
    middle = line.table[len(line.table) // 2, :2]
    want = ring()[(140 + (314 - 40) // 2) % 314]
    assert np.linalg.norm(middle - want) < 0.3


@pytest.mark.parametrize("turn", [0, 2, 150])
def test_a_loop_with_short_gaps_only_stays_closed(turn):
    points = ring()
    keep = np.ones(314, bool)
    keep[[*range(0, 4), *range(60, 65)]] = False
    keep = np.roll(keep, -turn)
    points = np.roll(points, -turn, axis=0)
    (line,) = drawn(chain(np.concatenate([points, points[:1]])), np.append(keep, keep[0]))
    assert line.closed and len(line.table) == 314


def test_what_runs_beside_a_stronger_line_is_left_out():
    before = [Line("outline", np.column_stack([straight(20.0), np.ones(201)]), False)]
    assert drawn(chain(straight(20.0, at=0.5)), before=before) == []
    # Near all along, though never that near: dashes if it were judged point by point.
    assert drawn(chain(straight(20.0, at=0.8)), before=before) == []
    assert len(drawn(chain(straight(20.0, at=1.0)), before=before)) == 1


def test_of_two_lines_on_one_another_one_is_drawn():
    both = np.concatenate([straight(20.0), straight(15.0, at=0.1)])
    chains = chain(both)
    chains = Chains(
        chains.points, chains.strength, chains.normals, chains.slack, np.array([0, 201, 352])
    )
    for kind in ("suggestive", "contour", "crease"):
        (line,) = drawn(chains, kind=kind)
        assert length(line.table) == pytest.approx(20.0)


@pytest.mark.parametrize(
    ("kind", "span", "alone", "meeting"),
    [
        ("suggestive", 2.5, 0, 0),
        ("contour", 2.5, 0, 1),
        ("contour", 1.3, 0, 0),
        ("crease", 1.3, 0, 1),
        ("crease", 3.1, 1, 1),
    ],
)
def test_short_lines_that_bound_a_form_must_meet_another(kind, span, alone, meeting):
    assert len(drawn(chain(straight(span)), kind=kind)) == alone
    across = np.column_stack([np.full(101, span + 0.3), np.arange(-5, 5.01, STEP), np.ones(101)])
    lines = drawn(chain(straight(span)), before=[Line("outline", across, False)], kind=kind)
    assert len(lines) == meeting
