import numpy as np
from PIL import Image

from relieffab.layers.content import FONT, MESH, PICTURE, SVG, content_of


def test_content_counts_and_not_the_name(tmp_path):
    Image.fromarray(np.eye(20, dtype=np.uint8)).save(tmp_path / "a.stl", format="PNG")
    assert content_of(tmp_path / "a.stl") == PICTURE
    (tmp_path / "b.txt").write_text('<?xml version="1.0"?>\n<svg xmlns="x"/>')
    assert content_of(tmp_path / "b.txt") == SVG
    (tmp_path / "c.bin").write_bytes(b"OTTO" + bytes(20))
    assert content_of(tmp_path / "c.bin") == FONT
    (tmp_path / "d.obj").write_text("v 0 0 0")
    assert content_of(tmp_path / "d.obj") == MESH


def test_the_name_counts_where_the_content_says_nothing(tmp_path):
    for name, kind in (("a.png", PICTURE), ("a.svg", SVG), ("a.ttf", FONT), ("a.ply", MESH)):
        (tmp_path / name).write_bytes(b"nothing")
        assert content_of(tmp_path / name) == kind
    assert content_of(tmp_path / "missing.png") == MESH
