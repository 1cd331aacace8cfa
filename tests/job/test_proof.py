"""What is said of a verdict, and the simulated surface as a relief."""

import json

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.gcode.verify import Verification, figure_nodes
from relieffab.grid import Grid
from relieffab.job.certificate import check_certificate
from relieffab.job.proof import carved_relief, verification_part, write_pictures
from relieffab.job.settings import default_job
from relieffab.relief.model import Relief
from relieffab.stock import Stock


def judged(rows=30, cols=40, grown=2):
    """A relief, and a verdict of one that was carved 0.02 mm too high but for one node."""
    grid = Grid(rows, cols, 0.5, (2.0, 17.0))
    x, y = np.meshgrid(*grid.node_axes())
    heights = -np.clip(1 - ((x - 12) / 8) ** 2 - ((y - 9.5) / 6) ** 2, 0, 1)
    relief = Relief(grid, heights, np.ones(grid.shape, bool), 1.0)
    wide = (rows + 2 * grown, cols + 2 * grown)
    origin = grid.to_xy(-grown, -grown)
    fine = Grid(4 * wide[0], 4 * wide[1], 0.125, origin)
    wanted = relief.height_at(*np.meshgrid(*fine.node_axes()))
    deviation = np.full(fine.node_shape, 0.02, np.float32)
    deviation[40, 60] = -0.03
    carved = (wanted + deviation).astype(np.float32)
    figure = figure_nodes(relief, fine, Stock(40.0, 30.0, 8.0))
    facts = (0.03, 0.02, 0.99, 0.1, 0.04, True, (), fine, figure, deviation, carved)
    return relief, Verification(*facts)


def test_numbers():
    relief, verdict = judged()
    part = verification_part(verdict, relief, ["one thing more"])
    assert part["deviation_mm"] == {
        "least": -0.03, "p01": 0.02, "median": 0.02, "p99": 0.02, "most": 0.02,
    }  # fmt: skip
    assert part["air_cutting"] == 0.04 and part["nodes_per_pixel"] == 4
    assert part["findings"] == ["one thing more"] and not part["ok"]
    json.dumps(part, allow_nan=False)


def test_the_surface_that_is_lit_lies_where_the_relief_lies():
    relief, verdict = judged()
    carved = carved_relief(verdict, relief)
    assert carved.grid.shape == (120, 160) and carved.grid.origin == relief.grid.origin
    x, y = np.meshgrid(np.linspace(5, 19, 50), np.linspace(5, 14, 40))
    wanted = relief.height_at(x, y) + 0.02
    assert np.abs(carved.height_at(x, y) - np.clip(wanted, -1, 0)).max() < 0.051
    assert np.median(np.abs(carved.height_at(x, y) - np.clip(wanted, -1, 0))) < 1e-6


def test_pictures(tmp_path):
    relief, verdict = judged()
    assert write_pictures(verdict, relief, Stock(20, 15, 5), default_job(), tmp_path) == {
        "deviation": "deviation.png",
        "look": "look.png",
    }
    assert {p.name for p in tmp_path.iterdir()} == {"deviation.png", "look.png"}


def test_programs_without_a_job_are_vouched_for_by_nobody(tmp_path):
    program = tmp_path / "a.nc"
    program.write_text("G21\n")
    assert "nobody proved it" in check_certificate(program)[0]
    (tmp_path / "report.json").write_text("{}")
    with pytest.raises(InputError, match="another schema"):
        check_certificate(program)
