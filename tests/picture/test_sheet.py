import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.picture.sheet import GAP, WIDEST, sheet


def greys(rows, cols, shape=(60, 80)):
    """Pictures each of one grey of its own."""
    level = np.linspace(0.2, 0.8, rows * cols).reshape(rows, cols)
    return [[np.full(shape, value) for value in row] for row in level]


def test_each_picture_lies_in_its_place():
    page = sheet(greys(2, 3), ["one", "two"], ["a", "b", "c"])
    assert page.dtype == np.uint8
    for i in range(2):
        for j in range(3):
            y = page.shape[0] - (2 - i) * (60 + GAP)
            x = page.shape[1] - (3 - j) * (80 + GAP)
            value = round(255 * (0.2 + 0.6 * (3 * i + j) / 5))
            assert (page[y : y + 60, x : x + 80] == value).all()


def test_labels_are_written_on_the_left_and_on_top():
    page = sheet([[np.ones((60, 80))] * 2], ["row"], ["left", "right"])
    first = page.shape[1] - 2 * (80 + GAP)
    top = page.shape[0] - (60 + GAP)
    assert page[top:, :first].min() < 100
    assert page[:top, first : first + 80].min() < 100
    assert page[:top, first + 80 + GAP :].min() < 100
    assert (page[top:, first:] == 255).all()


def test_a_long_label_has_room():
    short, long = (sheet(greys(1, 1), [word], ["a"]) for word in ("x", "x" * 40))
    assert long.shape[1] > short.shape[1]
    assert long[-60 - GAP :, : GAP // 2].min() == 255


def test_large_pictures_are_made_smaller():
    page = sheet(greys(1, 1, (300, 1200)), ["x"], ["a"])
    assert page.shape[1] < WIDEST + 100
    assert page.shape[0] < WIDEST // 4 + 60


@pytest.mark.parametrize(
    ("pictures", "rows", "cols"),
    [
        ([], [], []),
        (greys(1, 2), ["x"], ["a"]),
        (greys(2, 1), ["x"], ["a"]),
        ([[np.ones((3, 3)), np.ones((3, 4))]], ["x"], ["a", "b"]),
    ],
)
def test_what_does_not_make_a_sheet(pictures, rows, cols):
    with pytest.raises(InputError, match="sheet"):
        sheet(pictures, rows, cols)
