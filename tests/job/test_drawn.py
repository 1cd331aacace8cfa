import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.job.drawn import read_strokes, write_template
from relieffab.job.settings import default_job
from relieffab.layers.lines.svg import strokes_to_svg
from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief


def test_the_drawing_of_a_folder_becomes_its_template(tmp_path):
    (tmp_path / "layers").mkdir()
    with pytest.raises(InputError, match="no drawing"):
        read_strokes(tmp_path)
    line = Stroke(np.array([[10.0, 20.0], [30.0, 40.0]]), "contour", np.ones(2))
    (tmp_path / "layers" / "lines.svg").write_text(strokes_to_svg([line], (120.0, 90.0)))
    grid = Grid.on_panel((120.0, 90.0), (40, 30))
    heights = np.zeros(grid.node_shape)
    heights[8:20, 8:20] = -3.0
    relief = Relief(grid, heights, np.ones(grid.shape, bool), 3.0)
    job = default_job(paper="Letter")
    part = write_template(relief, read_strokes(tmp_path), job, tmp_path, name="model")
    assert part["files"] == ["template.svg", "contours.svg", "template.pdf"]
    assert (part["paper"], part["pages"]) == ("letter", 1)
    assert part["contour_step_mm"] == pytest.approx(0.6)
    texts = [(tmp_path / name).read_text() for name in ("template.svg", "contours.svg")]
    assert ['id="contour"' in text for text in texts] == [True, False]
