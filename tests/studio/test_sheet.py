from pathlib import Path

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.art.art import Art, Mark, Ring
from relieffab.layers.image.picture import Picture
from relieffab.studio import sheet as module
from relieffab.studio.sheet import lighter, load, save, sheet_of_art, sheet_of_picture


def picture(values, alpha=None, bits=8):
    values = values if values.ndim == 3 else values[..., None]
    return Picture(values, alpha, bits, "PNG", "a.png", ("a note",))


@pytest.fixture
def noise():
    return np.random.default_rng(0).random((37, 50, 3))


def test_a_lighter_picture_is_the_mean_of_what_shows_in_each_block(noise):
    noise[4, 5] = np.nan
    noise[8:12, 8:12] = np.nan
    made = lighter(picture(noise), 13)
    assert made.shape == (10, 13)
    for i in range(9):
        for j in range(12):
            block = noise[4 * i : 4 * i + 4, 4 * j : 4 * j + 4].reshape(-1, 3)
            block = block[np.isfinite(block).all(axis=1)]
            if len(block):
                np.testing.assert_allclose(made.values[i, j], block.mean(axis=0))
            else:
                assert np.isnan(made.values[i, j]).all()
    assert np.isnan(made.values[2, 2]).all()


def test_a_lighter_picture_keeps_an_even_ground_and_what_is_clear():
    values = np.full((60, 90, 1), 0.1)
    values[20:40, 30:60] = np.linspace(0.3, 0.9, 30)[:, None]
    alpha = np.ones((60, 90))
    alpha[:, :30] = 0.0
    made = lighter(picture(values, alpha), 30)
    assert (made.values[:4, 12:] == made.values[0, 12]).all()  # all of one value, to the last bit
    np.testing.assert_array_equal(made.alpha[:, :10], 0.0)
    np.testing.assert_array_equal(made.alpha[:, 10:], 1.0)
    assert np.isfinite(made.values).all()


def test_what_is_light_enough_stays_as_it_is(noise):
    small = picture(noise)
    assert lighter(small, 50) is small


@pytest.mark.parametrize("bits", [8, None])
def test_a_picture_comes_back_as_it_was_saved(noise, bits, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "TRIED", 25)
    alpha = np.ones(noise.shape[:2])
    alpha[:10] = 0.0
    made = sheet_of_picture(picture(noise, alpha, bits), Path("a.png"))
    save(made, tmp_path)
    back = load(tmp_path, Path("elsewhere/b.png"))
    assert (back.name, back.kind, back.shape) == ("b.png", made.kind, (37, 50))
    assert back.about == made.about and "50 x 37 pixels" in back.about
    assert back.notes == ("a note",)
    assert (back.flat.bits, back.flat.format) == (bits, "PNG")
    np.testing.assert_array_equal(back.flat.values, made.flat.values)
    np.testing.assert_array_equal(back.flat.alpha, made.flat.alpha)
    np.testing.assert_array_equal(back.shown, made.shown)
    assert back.box == (-0.5, -0.5, 24.5, 18.5)
    assert set(np.unique(back.shown[..., 3])) <= {0, 255}
    assert (back.shown[:5, :, 3] == 0).all()


@pytest.fixture
def art():
    """A ring of two circles, and a stroke below it."""
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    rings = (Ring(5 + 4 * circle, True), Ring(5 + 2 * circle, True))
    stroke = Ring(np.array([[0.0, 12.0], [10.0, 12.0]]), False)
    return Art((Mark(rings, "evenodd"), Mark((stroke,), width=0.5)), None, "r.svg", "svg", ("x",))


def test_art_comes_back_as_it_was_saved(art, tmp_path):
    made = sheet_of_art(art, Path("r.svg"))
    save(made, tmp_path)
    back = load(tmp_path, Path("r.svg"))
    assert (back.kind, back.about, back.notes) == ("svg", "SVG, 2 marks", ("x",))
    assert [m.fill for m in back.flat.marks] == ["evenodd", None]
    assert [m.width for m in back.flat.marks] == [None, 0.5]
    for one, other in zip(art.marks, back.flat.marks, strict=True):
        for ring, same in zip(one.rings, other.rings, strict=True):
            np.testing.assert_array_equal(ring.points, same.points)
            assert ring.closed == same.closed
    np.testing.assert_array_equal(back.shown, made.shown)


def test_art_is_shown_where_it_is(art):
    made = sheet_of_art(art, Path("r.svg"))
    left, top, right, bottom = made.box
    rows, cols = made.shown.shape[:2]

    def ink(x, y):
        at = int(rows * (y - top) / (bottom - top)), int(cols * (x - left) / (right - left))
        return made.shown[at][3]

    assert ink(5, 5) == 0  # the hole
    assert ink(5, 2) == 255 and ink(8, 5) == 255
    assert ink(3, 12) == 255
    assert ink(3, 10.5) == 0


def test_a_picture_that_shows_nothing_is_refused():
    with pytest.raises(InputError, match="all of one colour"):
        sheet_of_picture(picture(np.full((20, 20), 0.5)), Path("a.png"))
