import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.panel import cad
from relieffab.panel.step import read_step
from relieffab.stock import Stock


def test_a_solid_comes_back_as_it_was_written(tmp_path):
    pytest.importorskip("cadquery")
    cad.write_step(cad.stock_solid(Stock(40, 30, 8, corner=3)), tmp_path / "stock.step")
    vertices, faces = read_step(tmp_path / "stock.step")
    assert np.ptp(vertices, axis=0) == pytest.approx([40, 30, 8])
    corners = vertices[faces]
    volume = np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx((40 * 30 - (4 - np.pi) * 9) * 8, rel=1e-3)


def test_other_files_are_told(tmp_path):
    with pytest.raises(InputError, match="no such STEP"):
        read_step(tmp_path / "no.step")
    (tmp_path / "a.step").write_text("solid a")
    with pytest.raises(InputError, match="not a STEP file"):
        read_step(tmp_path / "a.step")
    pytest.importorskip("cadquery")
    (tmp_path / "b.step").write_text("ISO-10303-21;\nnothing\n")
    with pytest.raises(InputError, match=r"cannot be read|holds no solid"):
        read_step(tmp_path / "b.step")
