import io
import struct
import sys
import zlib

import imagecodecs
import numpy as np
import pytest
import tifffile
from PIL import Image

from relieffab.errors import InputError
from relieffab.layers.image.figure import opaque
from relieffab.layers.image.kind import kind_of
from relieffab.layers.image.read import picture_format, read_picture

RAMP = np.linspace(0, 255, 32 * 24).astype(np.uint8).reshape(24, 32)
COLOUR = np.stack([RAMP, RAMP[::-1], RAMP[:, ::-1]], axis=2)


def save(image, path, **more):
    image.save(path, **more)
    return path


@pytest.mark.parametrize(
    ("mode", "channels", "bits"),
    [("L", 1, 8), ("RGB", 3, 8), ("RGBA", 3, 8), ("LA", 1, 8), ("1", 1, 1), ("P", 3, 8)],
)
def test_every_kind_of_png_comes_as_it_was_meant(tmp_path, mode, channels, bits):
    image = Image.fromarray(COLOUR).convert(mode)
    picture = read_picture(save(image, tmp_path / "a.png"))
    assert (picture.values.shape, picture.bits) == ((24, 32, channels), bits)
    assert (picture.alpha is not None) == (mode in ("RGBA", "LA"))
    want = np.asarray(image.convert("RGB" if channels == 3 else "L"), float) / 255
    np.testing.assert_allclose(picture.values.reshape(want.shape), want)


def test_a_transparent_colour_is_no_part_of_the_figure(tmp_path):
    image = Image.fromarray((RAMP > 128).astype(np.uint8) * 200).convert("P")
    picture = read_picture(save(image, tmp_path / "a.png", transparency=0))
    np.testing.assert_array_equal(opaque(picture), RAMP > 128)


def test_sixteen_bits_and_floats_are_exact(tmp_path):
    fine = (np.arange(24 * 32, dtype=np.uint16) * 80).reshape(24, 32)
    png = read_picture(save(Image.fromarray(fine), tmp_path / "a.png"))
    np.testing.assert_array_equal(png.grey, fine / 65535)
    assert png.bits == 16
    floats = np.random.default_rng(0).normal(size=(24, 32)).astype(np.float32)
    floats[3, 4] = np.nan
    floats[3, 5] = np.inf
    tifffile.imwrite(tmp_path / "a.tif", floats)
    np.save(tmp_path / "a.npy", floats)
    for name in ("a.tif", "a.npy"):
        picture = read_picture(tmp_path / name)
        assert picture.bits is None
        assert np.isnan(picture.grey[3, 4:6]).all()
        assert opaque(picture).sum() == floats.size - 2
        assert picture.grey[0, 0] == floats[0, 0]


WIDE = np.random.default_rng(0).integers(0, 2**16, (24, 32, 4), np.uint16)


def wide_png(path, stored, *, size=None, clear=None, kept=1.0):
    """Write a PNG of 16 bits by hand, its rows unfiltered."""
    rows, cols, channels = stored.shape

    def chunk(name, data):
        whole = name + data
        return struct.pack(">I", len(data)) + whole + struct.pack(">I", zlib.crc32(whole))

    head = struct.pack(
        ">IIBBBBB", *(size or (cols, rows)), 16, {2: 4, 3: 2, 4: 6}[channels], 0, 0, 0
    )
    lines = b"".join(b"\0" + row.astype(">u2").tobytes() for row in stored)
    parts = [chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(lines)), chunk(b"IEND", b"")]
    if clear is not None:
        parts.insert(1, chunk(b"tRNS", clear.astype(">u2").tobytes()))
    data = b"\x89PNG\r\n\x1a\n" + b"".join(parts)
    path.write_bytes(data[: int(kept * len(data))])
    return path


@pytest.mark.parametrize("channels", [2, 3, 4])
def test_a_png_keeps_its_colours_of_sixteen_bits(tmp_path, channels):
    stored = WIDE[..., :channels]
    picture = read_picture(wide_png(tmp_path / "a.png", stored))
    colours = stored if channels == 3 else stored[..., :-1]
    np.testing.assert_array_equal(picture.values, colours / 65535)
    assert (picture.bits, picture.notes) == (16, ())
    if channels != 3:
        np.testing.assert_array_equal(picture.alpha, stored[..., -1] / 65535)


def test_a_wide_png_may_name_a_transparent_colour(tmp_path):
    picture = read_picture(wide_png(tmp_path / "a.png", WIDE[..., :3], clear=WIDE[5, 6, :3]))
    assert np.argwhere(~opaque(picture)).tolist() == [[5, 6]]
    np.testing.assert_array_equal(picture.values, WIDE[..., :3] / 65535)


@pytest.mark.parametrize("kept", [0.3, 0.9])
def test_a_truncated_wide_png_is_refused(tmp_path, kept):
    with pytest.raises(InputError, match="cannot be read"):
        read_picture(wide_png(tmp_path / "a.png", WIDE, kept=kept))


@pytest.mark.parametrize("size", [(30_000, 20), (9000, 9000)])
def test_a_wide_png_is_measured_before_it_is_decoded(tmp_path, monkeypatch, size):
    path = wide_png(tmp_path / "a.png", WIDE, size=size)
    monkeypatch.setattr(imagecodecs, "png_decode", None)
    with pytest.raises(InputError, match="too large"):
        read_picture(path)


@pytest.mark.parametrize("compression", [None, "zlib", "lzw"])
def test_tiff_of_every_usual_compression(tmp_path, compression):
    if compression == "lzw":
        save(Image.fromarray(COLOUR), tmp_path / "a.tif", compression="tiff_lzw")
    else:
        tifffile.imwrite(tmp_path / "a.tif", COLOUR, photometric="rgb", compression=compression)
    np.testing.assert_allclose(read_picture(tmp_path / "a.tif").values, COLOUR / 255)


def test_exr_with_its_library(tmp_path):
    exr = pytest.importorskip("OpenEXR")
    depth = np.random.default_rng(1).random((24, 32)).astype(np.float32)
    header = {"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}
    exr.File(header, {"Z": depth}).write(str(tmp_path / "a.exr"))
    picture = read_picture(tmp_path / "a.exr")
    np.testing.assert_array_equal(picture.grey, depth)
    assert kind_of(picture) == "depth"


def test_exr_without_its_library_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    (tmp_path / "a.exr").write_bytes(b"\x76\x2f\x31\x01" + bytes(100))
    with pytest.raises(InputError, match=r"relieffab\[exr\]"):
        read_picture(tmp_path / "a.exr")


def test_cmyk_is_turned_into_rgb_and_said_so(tmp_path):
    path = save(Image.fromarray(COLOUR).convert("CMYK"), tmp_path / "a.jpg", quality=95)
    picture = read_picture(path)
    assert picture.values.shape == (24, 32, 3)
    assert "CMYK" in picture.notes[0]
    tifffile.imwrite(tmp_path / "a.tif", np.zeros((24, 32, 4), np.uint8), photometric="separated")
    with pytest.raises(InputError, match="CMYK"):
        read_picture(tmp_path / "a.tif")


def test_a_turned_photograph_stands_upright(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6
    path = save(Image.fromarray(COLOUR), tmp_path / "a.jpg", exif=exif)
    assert read_picture(path).shape == (32, 24)


def _animated(path, kind):
    frames = [Image.fromarray(np.roll(RAMP, k, axis=1)) for k in range(3)]
    frames[0].save(path, format=kind, save_all=True, append_images=frames[1:])


@pytest.mark.parametrize(("kind", "name"), [("GIF", "a.gif"), ("PNG", "a.png"), ("WEBP", "a.webp")])
def test_an_animation_is_refused(tmp_path, kind, name):
    _animated(tmp_path / name, kind)
    with pytest.raises(InputError, match="3 pictures"):
        read_picture(tmp_path / name)


def test_several_pages_are_refused(tmp_path):
    tifffile.imwrite(tmp_path / "a.tif", np.stack([RAMP, RAMP]), photometric="minisblack")
    with pytest.raises(InputError, match="2 pages"):
        read_picture(tmp_path / "a.tif")


@pytest.mark.parametrize("size", [(1, 1), (8, 200), (30_000, 20), (9000, 9000)])
def test_pictures_too_small_or_too_large(tmp_path, size):
    path = save(Image.new("L", size), tmp_path / "a.png")
    with pytest.raises(InputError, match=r"too (small|large)") as fault:
        read_picture(path)
    assert f"{size[0]} x {size[1]}" in str(fault.value)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "TIFF", "GIF", "BMP"])
def test_a_truncated_file_is_refused(tmp_path, kind):
    buffer = io.BytesIO()
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (64, 64), np.uint8)).save(
        buffer, kind
    )
    (tmp_path / "a").write_bytes(buffer.getvalue()[: len(buffer.getvalue()) // 2])
    with pytest.raises(InputError, match="cannot be read"):
        read_picture(tmp_path / "a")


@pytest.mark.parametrize("start", [b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"II*\0", b"\x93NUMPY"])
def test_a_broken_file_is_refused(tmp_path, start):
    (tmp_path / "a").write_bytes(start + bytes(range(200)))
    with pytest.raises(InputError, match="cannot be read"):
        read_picture(tmp_path / "a")


def test_what_is_no_picture_is_refused(tmp_path):
    (tmp_path / "a.png").write_text("not a picture")
    with pytest.raises(InputError, match="not a picture"):
        read_picture(tmp_path / "a.png")
    with pytest.raises(InputError, match="no such picture"):
        read_picture(tmp_path / "b.png")
    assert picture_format(b"RIFF\0\0\0\0WEBPVP8 ") == "WEBP"
    assert picture_format(b"RIFF\0\0\0\0WAVEfmt ") is None


@pytest.mark.parametrize(
    "array",
    [
        np.zeros((20, 20, 5)),
        np.zeros((2, 20, 20, 3)),
        np.zeros(400),
        np.zeros((20, 20), complex),
        np.full((20, 20), -1, np.int16),
        np.array([{"a": 1}] * 400).reshape(20, 20),
    ],
)
def test_arrays_of_no_picture_are_refused(tmp_path, array):
    np.save(tmp_path / "a.npy", array, allow_pickle=True)
    with pytest.raises(InputError, match="cannot be read"):
        read_picture(tmp_path / "a.npy")


def test_only_colours_of_sixteen_bits_are_said_to_be_read_as_eight(tmp_path):
    """A row of this picture takes 116 bytes, a number that Pillow names beside the colours."""
    image = Image.new("RGB", (38, 20), "white")
    assert read_picture(save(image, tmp_path / "a.bmp")).notes == ()
