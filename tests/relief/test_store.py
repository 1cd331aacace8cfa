import json

import numpy as np
import pytest
import tifffile

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.about import describe
from relieffab.relief.model import Relief
from relieffab.relief.png import to_png
from relieffab.relief.store import read_relief, to_tiff


@pytest.fixture
def relief():
    rng = np.random.default_rng(0)
    grid = Grid(7, 9, 0.117, (3.25, 60.5))
    return Relief(grid, -0.1 * rng.random(grid.node_shape), rng.random(grid.shape) > 0.5, 0.1)


def test_what_is_written_comes_back(relief, tmp_path):
    path = tmp_path / "relief.tiff"
    path.write_bytes(to_tiff(relief))
    back = read_relief(path)
    assert back.grid == relief.grid
    assert back.depth == relief.depth
    np.testing.assert_array_equal(back.mask, relief.mask)
    np.testing.assert_allclose(back.heights, relief.heights, atol=1e-8)


def test_any_tiff_reader_finds_millimetres(relief, tmp_path):
    path = tmp_path / "relief.tiff"
    path.write_bytes(to_tiff(relief))
    with tifffile.TiffFile(path) as file:
        assert file.pages[0].dtype == np.float32
        assert json.loads(file.pages[0].description)["pitch_mm"] == 0.117


def test_the_bound_survives_single_precision(tmp_path):
    grid = Grid(2, 2, 1.0, (0.0, 2.0))
    deepest = Relief(grid, np.full((3, 3), -0.1), np.ones((2, 2), bool), 0.1)
    (tmp_path / "r.tiff").write_bytes(to_tiff(deepest))
    assert read_relief(tmp_path / "r.tiff").heights.min() == -0.1


def test_other_files_are_refused(tmp_path):
    with pytest.raises(InputError, match="no such relief"):
        read_relief(tmp_path / "none.tiff")
    (tmp_path / "text.tiff").write_text("not a picture")
    with pytest.raises(InputError, match="cannot be read"):
        read_relief(tmp_path / "text.tiff")
    tifffile.imwrite(tmp_path / "other.tiff", np.zeros((4, 4), np.float32))
    with pytest.raises(InputError, match=r"not a relief of ours|cannot be read"):
        read_relief(tmp_path / "other.tiff")


def test_heights_come_back_as_single_precision_has_them(relief, tmp_path):
    (tmp_path / "relief.tiff").write_bytes(to_tiff(relief))
    back = read_relief(tmp_path / "relief.tiff")
    np.testing.assert_array_equal(back.heights, relief.heights.astype(np.float32).astype(float))


def test_the_first_bytes_tell_the_format_not_the_name(relief, tmp_path):
    (tmp_path / "a.tiff").write_bytes(to_png(relief))
    (tmp_path / "b.png").write_bytes(to_tiff(relief))
    for name, error in (("a.tiff", relief.depth / 65535 / 2), ("b.png", 1e-8)):
        back = read_relief(tmp_path / name)
        np.testing.assert_allclose(back.heights, relief.heights, atol=error * 1.000001, rtol=0)


@pytest.mark.parametrize("pages", [1, 3])
def test_a_tiff_with_our_words_and_other_pages_is_refused(relief, tmp_path, pages):
    with tifffile.TiffWriter(tmp_path / "r.tiff") as writer:
        for _ in range(pages):
            writer.write(np.zeros((8, 10), np.float32), description=describe(relief), metadata=None)
    with pytest.raises(InputError, match="two pages"):
        read_relief(tmp_path / "r.tiff")
