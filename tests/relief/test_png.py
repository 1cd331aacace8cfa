import base64
import io
import zlib

import numpy as np
import pytest
from PIL import Image, PngImagePlugin

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.relief.png import MASK, SIZE, grey, to_png
from relieffab.relief.store import read_relief


@pytest.fixture
def relief():
    rng = np.random.default_rng(0)
    grid = Grid(7, 9, 0.1171875, (3.25, 60.5))
    heights = -0.1 * rng.random(grid.node_shape)
    heights[0], heights[1] = 0.0, -0.1
    return Relief(grid, heights, rng.random(grid.shape) > 0.5, 0.1)


def saved(path, pixels, **texts):
    words = PngImagePlugin.PngInfo()
    for key, text in texts.items():
        words.add_text(key.replace("_", " "), text)
    Image.fromarray(pixels).save(path, pnginfo=words)
    return path


def texts_of(relief):
    info = Image.open(io.BytesIO(to_png(relief))).info
    return {SIZE: info[SIZE], "relieffab_mask": info[MASK]}


def test_heights_come_back_within_half_a_grey_and_all_else_exactly(relief, tmp_path):
    (tmp_path / "relief.png").write_bytes(to_png(relief))
    back = read_relief(tmp_path / "relief.png")
    error = np.abs(back.heights - relief.heights).max()
    assert 0 < error <= relief.depth / 65535 / 2 * 1.000001
    assert (back.grid, back.depth) == (relief.grid, relief.depth)
    np.testing.assert_array_equal(back.mask, relief.mask)
    # The face and the floor are greys of their own.
    assert (back.heights[0] == 0).all()
    assert (back.heights[1] == -0.1).all()
    assert to_png(back) == to_png(relief)


def test_any_reader_finds_the_pitch_and_what_grey_means(relief):
    image = Image.open(io.BytesIO(to_png(relief)))
    assert image.mode == "I;16"
    assert image.info["dpi"] == pytest.approx((25.4 / 0.1171875,) * 2, rel=1e-4)
    assert image.info["Description"] == (
        "Heights of a sunken relief: grey 65535 is the panel's face, grey 0 lies 0.1 mm below it; "
        "samples are 0.117188 mm apart."
    )


def test_a_picture_of_others_is_told_what_it_lacks(relief, tmp_path):
    pixels = np.full((8, 10), 65535, np.uint16)
    with pytest.raises(InputError, match="no 'relieffab' and no 'relieffab mask'"):
        read_relief(saved(tmp_path / "foreign.png", pixels))
    half = {SIZE: texts_of(relief)[SIZE]}
    with pytest.raises(InputError, match="found: no 'relieffab mask'"):
        read_relief(saved(tmp_path / "half.png", pixels, **half))
    with pytest.raises(InputError, match="expected: 16-bit grey"):
        read_relief(saved(tmp_path / "eight.png", pixels.astype(np.uint8), **texts_of(relief)))


def test_a_mask_that_does_not_fit_is_refused(relief, tmp_path):
    pixels = np.full((8, 10), 65535, np.uint16)
    with pytest.raises(InputError, match="mask does not fit"):
        read_relief(saved(tmp_path / "cropped.png", pixels[:-2], **texts_of(relief)))
    with pytest.raises(InputError, match="mask is broken"):
        read_relief(
            saved(tmp_path / "r.png", pixels, **(texts_of(relief) | {"relieffab_mask": "?"}))
        )
    bomb = base64.b64encode(zlib.compress(bytes(10**7))).decode()
    with pytest.raises(InputError, match="mask does not fit"):
        read_relief(
            saved(tmp_path / "b.png", pixels, **(texts_of(relief) | {"relieffab_mask": bomb}))
        )


def test_half_a_file_is_refused(relief, tmp_path):
    data = to_png(relief)
    for count in (8, 60, len(data) - 40):
        (tmp_path / "half.png").write_bytes(data[:count])
        with pytest.raises(InputError, match="cannot be read"):
            read_relief(tmp_path / "half.png")


def test_grey_runs_from_depth_to_face(relief):
    assert (grey(relief).min(), grey(relief).max()) == (0, 1)
    assert grey(relief)[2, 3] == pytest.approx(1 + relief.heights[2, 3] / 0.1)
