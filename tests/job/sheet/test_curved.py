import numpy as np
import pytest

from relieffab.job.sheet import curved
from relieffab.round import Curved


def test_a_board_is_as_thick_as_its_middle_and_thinner_at_the_sides():
    board = Curved(60, 45, 12, 60)
    drawing = curved.draw(board, 3.0)
    path = next(line.path for line in drawing.lines if line.kind == "stock")
    corners = path.removeprefix("M").removesuffix(" Z").split(" L")
    outline = np.array([[float(n) for n in corner.split()] for corner in corners])
    scale = np.ptp(outline[:, 0]) / (120 * np.sin(0.5))
    assert np.ptp(outline[:, 1]) == pytest.approx(12 * scale, abs=0.2)
    assert outline[0, 1] - outline[:, 1].min() == pytest.approx(board.sagitta * scale, abs=0.2)
    texts = {word.text for word in drawing.words}
    assert {"12 mm", "3 mm deep", "57.53 mm", f"{board.wall:.2f} mm"} <= texts
    assert not any("deep" in word.text for word in curved.draw(board, 0.0).words)
