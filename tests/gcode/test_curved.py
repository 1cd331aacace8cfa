"""Programs for a board whose face is curved: planned from above, judged from their text."""

import numpy as np
import pytest

from relieffab import profiles
from relieffab.gcode.ease import eased
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import verify
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.relief.laid import laid
from relieffab.relief.model import Relief, inner_nodes
from relieffab.round import Curved
from relieffab.stock import Stock
from relieffab.toolpath.plan import plan

BOARD = Curved(40, 24, 9, 70)
STOCK = Stock(BOARD.breadth, BOARD.height, BOARD.thickness, curve=BOARD.radius)
GRID = Grid(96, 160, 0.25, (0.0, 24.0))
MACHINE, WOOD = profiles.machine("3018-prover"), profiles.material("softwood")


def relief():
    """A field with drafted walls up to where the board falls away, a dome in its middle."""
    x, y = np.meshgrid(*GRID.node_axes())
    mask = np.zeros(GRID.shape, bool)
    mask[16:80, 20:140] = True
    inside = np.minimum.reduce([x - 5, 35 - x, y - 4, 20 - y])
    dome = 0.5 * np.exp(-((x - 20) ** 2 + (y - 12) ** 2) / 12)
    heights = np.where(inner_nodes(mask), dome - np.clip(inside * 4, 0, 1.4), 0.0)
    return Relief(GRID, np.clip(heights, -2, 0), mask, 2.0)


@pytest.fixture(scope="module")
def made():
    """The relief from above, its setup, cutters and programs."""
    seen = laid(relief(), STOCK)
    setup = Setup(MACHINE, WOOD, STOCK, STOCK.lowest(2.0))
    cutters = tuple(profiles.cutter(name) for name in ("flat-3.175", "ball-2", "ball-1"))
    paths = plan(seen, [], MACHINE, WOOD, cutters=cutters, stock=STOCK)
    slab = Slab.whole(seen.grid, STOCK)
    texts = [write_program(eased(path, setup, slab), setup, slab) for path in paths]
    return seen, setup, [path.cutter for path in paths], texts


def test_a_relief_on_a_curved_board_is_carved(made):
    seen, setup, cutters, texts = made
    verdict = verify(texts, cutters, seen, setup)
    assert verdict.ok, verdict.findings
    assert verdict.gouge_mm <= 0.001
    assert verdict.within_tolerance > 0.95
    # The face beside the figure falls by 2.8 mm, and nobody touches it.
    assert 0.5 < verdict.figure.mean() < 0.6
    beside = verdict.deviation[~verdict.figure]
    assert np.abs(beside).max() < 0.06
    assert seen.heights[0, 0] == pytest.approx(-BOARD.sagitta, abs=1e-3)
    # Hardly any of the way cuts the air over the sides.
    assert verdict.air_cutting < 0.05
    assert "its face curved along X" in " ".join(texts[0].replace(")\n(", " ").split())


def test_programs_for_a_level_slab_gouge_it(made):
    """The judgement can fail: what carves the relief into a level slab is refused here."""
    seen, setup, cutters, _ = made
    flat = Stock(40, 24, 9)
    level = Setup(MACHINE, WOOD, flat, 2.0)
    slab = Slab.whole(GRID, flat)
    (path, *_) = plan(relief(), [], MACHINE, WOOD, cutters=tuple(cutters), stock=flat)
    text = write_program(eased(path, level, slab), level, slab)
    verdict = verify([text], cutters[:1], seen, setup)
    assert not verdict.ok


def test_the_stock_stands_as_its_face():
    slab = Slab.whole(laid(relief(), STOCK).grid, STOCK)
    x, _ = slab.grid.node_axes()
    np.testing.assert_allclose(slab.heights[3], STOCK.face(x), atol=1e-6)
