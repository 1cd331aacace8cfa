import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.image.ink import InkSight, ink_of, strokes_of
from relieffab.layers.lines.drawing import Drawing

GRID = Grid.on_panel((40.0, 30.0), (320, 240))


def drawing():
    i, j = np.indices((240, 320))
    ink = np.abs(np.hypot(i - 120, j - 160) - 80) < 3
    return ink | (np.abs(i - 120) < 2) & (np.abs(j - 160) < 60)


@pytest.mark.parametrize("paper", [1.0, 0.85, 0.1])
def test_ink_is_what_differs_from_the_paper(make_picture, paper):
    tone = 0.1 if paper > 0.5 else 0.9
    picture = make_picture(np.where(drawing(), tone, paper))
    np.testing.assert_array_equal(ink_of(picture) > 0.5, drawing())


def test_ink_on_nothing(make_picture):
    ink = drawing().astype(float)
    black = make_picture(np.zeros(ink.shape), alpha=ink)
    np.testing.assert_allclose(ink_of(black), ink)
    with pytest.raises(InputError, match="one tone"):
        ink_of(make_picture(np.full((30, 30), 0.7)))


def test_strokes_run_through_the_middle_and_know_their_width():
    strokes = strokes_of(drawing().astype(float), GRID, 0.01)
    assert [stroke.closed for stroke in strokes] == [True, False]
    assert {stroke.kind for stroke in strokes} == {"drawn"}
    ring, bar = strokes
    x, y = GRID.to_xy(120.5, 160.5)
    np.testing.assert_allclose(np.hypot(*(ring.points - [x, y]).T), 10.0, atol=0.15)
    np.testing.assert_allclose(bar.points[:, 1], y, atol=0.15)
    assert ring.strength.mean() > bar.strength.mean()


def test_layers_of_a_drawing_are_level_and_keep_its_ink(make_picture):
    picture = make_picture(np.where(drawing(), 0.0, 1.0))
    sight = InkSight.of(picture, GRID, (40.0, 30.0), 3.0, {})
    layers, fit = sight.layers(sight.strokes(Drawing()), Drawing()), sight.fit
    assert layers.level
    wide = 166 * fit.scale
    cols = np.flatnonzero((layers.lines > 0.5).any(axis=0))
    assert np.ptp(cols) * GRID.pitch == pytest.approx(wide, rel=0.02)
    assert wide == pytest.approx(24.0, rel=0.02)
