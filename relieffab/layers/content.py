"""What a model's file is, told by what is in it rather than by its name."""

from pathlib import Path

from relieffab.layers.image.read import SUFFIXES, picture_format

MESH, PICTURE, SVG, FONT = "mesh", "picture", "svg", "font"

_FONTS = (b"\0\1\0\0", b"OTTO", b"true", b"ttcf", b"wOFF", b"wOF2")
_BY_NAME = {
    **dict.fromkeys(SUFFIXES, PICTURE),
    ".svg": SVG,
    **dict.fromkeys((".ttf", ".otf", ".ttc", ".woff", ".woff2"), FONT),
}
LOOK = 4096
"""Bytes in which an SVG names itself."""


def content_of(path: str | Path) -> str:
    """Tell a mesh, a picture, an SVG and a font apart.

    Parameters
    ----------
    path : str or Path
        Where nothing is told by the content, the name's ending counts; a file that
        is not there is taken for a mesh, whose reader says so.
    """
    path = Path(path)
    if not path.is_file():
        return MESH
    with path.open("rb") as file:
        start = file.read(LOOK)
    if start.startswith(_FONTS):
        return FONT
    if picture_format(start[:16]) is not None:
        return PICTURE
    if start.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<") and b"<svg" in start:
        return SVG
    return _BY_NAME.get(path.suffix.lower(), MESH)
