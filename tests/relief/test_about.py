import json

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.about import About, describe, understand
from relieffab.relief.model import Relief


def test_what_is_described_is_understood():
    grid = Grid(1, 1, 0.1171875, (1 / 3, 60.5))
    relief = Relief(grid, np.zeros((2, 2)), np.ones((1, 1), bool), 2.9)
    text = describe(relief, face_grey=65535)
    assert json.loads(text)["face_grey"] == 65535
    assert understand(text, "here") == About(0.1171875, (1 / 3, 60.5), 2.9)


@pytest.mark.parametrize(
    "change",
    [{"depth_mm": 0}, {"depth_mm": float("nan")}, {"origin_mm": [1]}, {"origin_mm": 3},
     {"pitch_mm": "wide"}, {"pitch_mm": float("inf")}],
)  # fmt: skip
def test_sizes_that_are_none_are_refused(change):
    facts = {"format": "relieffab relief 1", "pitch_mm": 1, "origin_mm": [0, 9], "depth_mm": 2}
    with pytest.raises(InputError, match=r"does not say its size(.|\n)*where: here"):
        understand(json.dumps(facts | change), "here")


@pytest.mark.parametrize("text", ["", "ImageJ=1.5", "[]", '{"format": "other"}'])
def test_words_of_others_are_refused(text):
    with pytest.raises(InputError, match="not a relief of ours"):
        understand(text, "here")
