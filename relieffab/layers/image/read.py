"""Picture files: PNG, JPEG, TIFF, BMP, WebP, GIF and PNM, NPY, and EXR with its library."""

import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.image.picture import Picture

Floats = NDArray[np.float64]

SUFFIXES = (
    *(".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp", ".gif", ".pgm", ".ppm"),
    *(".npy", ".exr"),
)
WIDEST = 16384
"""Pixels each way: no grid is finer."""
MOST = 64_000_000
"""Pixels in all."""
_MAGIC = {
    b"\x89PNG\r\n\x1a\n": "PNG",
    b"\xff\xd8\xff": "JPEG",
    b"II*\0": "TIFF",
    b"MM\0*": "TIFF",
    b"II+\0": "TIFF",
    b"BM": "BMP",
    b"GIF8": "GIF",
    b"P5": "PPM",
    b"P6": "PPM",
    b"\x93NUMPY": "NPY",
    b"\x76\x2f\x31\x01": "EXR",
}
_Read = tuple[NDArray[Any], Floats | None, int | None, tuple[str, ...]]
"""Values, alpha, bits and notes."""
_BROKEN = (
    *(OSError, SyntaxError, ValueError, EOFError, IndexError, KeyError, TypeError),
    *(zlib.error, RuntimeError),
)
"""What readers and their codecs raise of a file that is not sound; of imagecodecs RuntimeError."""
_PLAIN = (1, 8, 32946, 32773)
"""Compressions of TIFF that need no library of their own: none, deflate, packed bits."""
_CMYK = 5
_ORIENTATION = 0x0112
"""In EXIF."""


def picture_format(start: bytes) -> str | None:
    """Tell a picture file's format by its first 16 bytes; None if it is none."""
    if start[:4] == b"RIFF" and start[8:12] == b"WEBP":
        return "WEBP"
    found = [name for magic, name in _MAGIC.items() if start.startswith(magic)]
    return found[0] if found else None


def read_picture(path: str | Path) -> Picture:
    """Read one picture from a file.

    Raises
    ------
    InputError
        If it is missing, broken, holds several pictures, or is too large or too
        small for a relief.
    """
    path = Path(path)
    where = str(path)
    if not path.is_file():
        raise InputError("there is no such picture", where=where)
    with path.open("rb") as file:
        kind = picture_format(file.read(16))
    if kind is None:
        raise InputError(
            "this is not a picture, whatever its name says",
            expected=" ".join(sorted({*_MAGIC.values(), "WEBP"})),
            found=f"{path.stat().st_size} bytes of something else",
            where=where,
        )
    reader = {"TIFF": _tiff, "NPY": _npy, "EXR": _exr}.get(kind, _pillow)
    try:
        array, alpha, bits, notes = reader(path)
    except _BROKEN as fault:
        raise InputError(
            "the picture cannot be read",
            expected=f"a sound {kind} file",
            found=f"{type(fault).__name__}: {fault}".splitlines()[0][:200],
            where=where,
        ) from fault
    values = np.array(array if array.ndim == 3 else array[..., None], np.float64)
    values[~np.isfinite(values)] = np.nan
    _check_size(values.shape[1], values.shape[0], where)
    return Picture(values, alpha, bits, kind, path.name, notes)


def _check_size(width: int, height: int, where: str) -> None:
    if max(width, height) > WIDEST or width * height > MOST:
        raise InputError(
            "the picture is too large",
            expected=f"at most {WIDEST} pixels each way and {MOST // 10**6} million in all",
            found=f"{width} x {height}",
            where=where,
            hint="a smaller copy: no relief shows more than --resolution",
        )
    if min(width, height) < 16:
        raise InputError(
            "the picture is too small to show anything",
            expected="16 pixels or more each way",
            found=f"{width} x {height}",
            where=where,
        )


def _several(count: int, what: str, where: str) -> InputError:
    return InputError(
        f"the file holds {count} {what}, and which one is meant is not known",
        expected="one picture",
        where=where,
        hint="save the one you mean as a file of its own",
    )


def _split(array: NDArray[Any], top: float) -> tuple[Floats, Floats | None]:
    """Scale to 0 to 1, and part colour from alpha."""
    scaled = np.asarray(array, np.float64) / top
    if scaled.ndim == 3 and scaled.shape[2] in (2, 4):
        return scaled[..., :-1], scaled[..., -1]
    return scaled, None


def _pillow(path: Path) -> _Read:
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with Image.open(path, formats=["PNG", "JPEG", "BMP", "GIF", "WEBP", "PPM", "TIFF"]) as raw:
            _check_size(*raw.size, str(path))
            frames = getattr(raw, "n_frames", 1)
            if frames > 1:
                raise _several(frames, "pictures", str(path))
            wide = _is_wide(raw)
            turned = raw.getexif().get(_ORIENTATION, 1) != 1
            if wide and raw.format == "PNG":
                return _wide_png(path, turned=turned)
            raw.load()
            image = ImageOps.exif_transpose(raw)
    except (Image.DecompressionBombError, UnidentifiedImageError) as fault:
        raise ValueError(str(fault)) from fault
    notes = ("its 16 bits a channel were read as 8: a PNG or TIFF keeps them",) if wide else ()
    mode = image.mode
    if mode == "F":
        return np.asarray(image), None, None, notes
    if mode.startswith("I"):
        return np.asarray(image, np.float64) / 65535, None, 16, notes
    if mode in ("P", "PA"):
        clear = mode == "PA" or "transparency" in image.info
        image = image.convert("RGBA" if clear else "RGB")
    elif mode == "1":
        image = image.convert("L")
    elif mode not in ("L", "LA", "RGB", "RGBA"):
        notes = (*notes, f"{mode} was turned into RGB without a colour profile")
        image = image.convert("RGB")
    elif "transparency" in image.info:
        image = image.convert("RGBA")
    values, alpha = _split(np.asarray(image), 255.0)
    return values, alpha, 1 if mode == "1" else 8, notes


def _is_wide(image: Any) -> bool:
    """Whether a file's colours have 16 bits each, by what Pillow is to read them as."""
    told = [tile[3][0] if isinstance(tile[3], tuple) else tile[3] for tile in image.tile]
    # BGR;16 are 16 bits a pixel.
    wide = any(";16" in str(mode) and not str(mode).startswith("BGR") for mode in told)
    return wide and "I" not in image.mode


def _wide_png(path: Path, *, turned: bool) -> _Read:
    """Read a PNG's colours of 16 bits, of which Pillow keeps 8; its size is checked."""
    import imagecodecs

    array = imagecodecs.png_decode(path.read_bytes())
    values, alpha, bits, _ = _of_array(array)
    notes = ("what EXIF says of its orientation was not heeded",) if turned else ()
    return values, alpha, bits, notes


def _tiff(path: Path) -> _Read:
    import tifffile

    try:
        with tifffile.TiffFile(path) as file:
            if len(file.pages) > 1:
                raise _several(len(file.pages), "pages", str(path))
            page = file.pages[0]
            _check_size(page.imagewidth, page.imagelength, str(path))
            if page.photometric == _CMYK:
                raise ValueError("CMYK, where grey or RGB is wanted")
            if page.compression not in _PLAIN:
                return _pillow(path)
            array = page.asarray()
    except tifffile.TiffFileError as fault:
        raise ValueError(str(fault)) from fault
    if array.ndim == 3 and array.shape[0] <= 4 < array.shape[2]:
        array = np.moveaxis(array, 0, 2)
    return _of_array(array)


def _npy(path: Path) -> _Read:
    return _of_array(np.load(path, allow_pickle=False))


def _exr(path: Path) -> _Read:
    try:
        import OpenEXR
    except ImportError as fault:
        raise InputError(
            "EXR needs a library that is not installed",
            where=str(path),
            hint="pip install 'relieffab[exr]', or save it as a float TIFF",
        ) from fault
    try:
        with OpenEXR.File(str(path)) as file:
            channels = {name: channel.pixels for name, channel in file.channels().items()}
    except RuntimeError as fault:
        raise ValueError(str(fault)) from fault
    for name in ("RGBA", "RGB", "Y", "Z", "V", "R"):
        if name in channels:
            return _of_array(channels[name])
    if len(channels) == 1:
        return _of_array(next(iter(channels.values())))
    raise ValueError(f"channels {', '.join(channels)}, where RGB, RGBA, Y or Z is wanted")


def _of_array(array: NDArray[Any]) -> _Read:
    """Take an array as a picture: (rows, cols) or (rows, cols, 1 to 4)."""
    if array.ndim not in (2, 3) or (array.ndim == 3 and array.shape[2] not in (1, 2, 3, 4)):
        raise ValueError(f"an array of shape {array.shape}, where (rows, cols[, 1 to 4]) is wanted")
    if array.dtype == bool:
        return *_split(array, 1.0), 1, ()
    if array.dtype.kind == "f":
        return *_split(array, 1.0), None, ()
    if array.dtype.kind in "ui" and array.dtype.itemsize <= 4:
        if array.min() < 0:
            raise ValueError(f"whole numbers below 0, as {array.min()}")
        top = float(np.iinfo(array.dtype).max)
        return *_split(array, top), 8 * array.dtype.itemsize, ()
    raise ValueError(f"values of type {array.dtype}")
