"""Every guard fires, and says what would fit."""

from dataclasses import replace

import numpy as np
import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.fittings import Frame
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath.check import check

GRID = Grid(30, 40, 1.0, (0.0, 30.0))


def relief_of(depth):
    heights = np.zeros(GRID.node_shape)
    heights[10:20, 10:20] = -depth
    return Relief(GRID, heights, np.ones(GRID.shape, bool), max(depth, 1.0))


GOOD = {
    "relief": relief_of(3.0),
    "machine": profiles.machine("3018-prover"),
    "cutters": tuple(
        profiles.cutter(name) for name in ("flat-3.175", "tapered-ball-1", "tapered-ball-0.5")
    ),
    "stock": Stock(40.0, 30.0, 12.0),
    "stepover": 0.2,
}
FLAT = GOOD["cutters"][0]


def test_a_good_job_passes():
    check(**GOOD)
    check(**{**GOOD, "stock": Stock(40.0, 30.0, 12.0, frame=Frame(9.0, -2.0))})
    check(**{**GOOD, "stock": Stock(40.0, 30.0, 12.0, frame=Frame(8.0, 2.0))})


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"relief": relief_of(0.0)}, "nothing to cut"),
        ({"stock": Stock(40.0, 30.0, 3.0)}, "through the stock"),
        ({"stock": Stock(40.0, 30.0, 12.0, frame=Frame(9.0, 2.0))}, "into the raised frame"),
        ({"stock": Stock(39.0, 30.0, 12.0)}, "beyond the stock"),
        ({"stock": Stock(300.0, 30.0, 12.0)}, "(?s)larger than the machine.*263 mm in X"),
        ({"stock": Stock(40.0, 160.0, 12.0)}, "157 mm in Y"),
        ({"machine": replace(GOOD["machine"], travel=(200.0, 200.0, 7.9))}, "7.9 mm in Z"),
        ({"cutters": (replace(FLAT, flute_length=2.9),) * 3}, "too short"),
        ({"cutters": (replace(FLAT, diameter=31.0),) * 3}, "larger than the panel"),
        ({"stepover": 0.0}, "stepover cannot be 0"),
        ({"stepover": 1.01}, "stepover cannot be 1.01"),
    ],
)
def test_what_cannot_be_carved_is_refused(values, word):
    with pytest.raises(InputError, match=word):
        check(**{**GOOD, **values})
