"""Pictures and drawings that were made to be no models, read without a process of its own."""

import numpy as np
import pytest
from PIL import Image

from relieffab.errors import InputError
from relieffab.studio.parse import _parse
from relieffab.studio.sheet import load


def _animated(path):
    noise = np.random.default_rng(0).integers(0, 255, (3, 40, 40), np.uint8)
    frames = [Image.fromarray(one) for one in noise]
    frames[0].save(path, save_all=True, append_images=frames[1:])


def _cut_short(path):
    noise = np.random.default_rng(0).integers(0, 255, (90, 90), np.uint8)
    Image.fromarray(noise).save(path)
    path.write_bytes(path.read_bytes()[:500])


LAUGHS = "".join(f'<!ENTITY l{k + 1} "{f"&l{k};" * 10}">' for k in range(9))
TRAPS = {
    "bomb.png": (lambda path: Image.new("1", (14000, 14000)).save(path), "too large|bomb"),
    "one.png": (lambda path: Image.new("L", (1, 1)).save(path), "too small"),
    "plain.png": (lambda path: Image.new("L", (40, 40), 9).save(path), "all of one colour"),
    "moving.gif": (_animated, "3 pictures"),
    "short.png": (_cut_short, "cannot be read"),
    "text.png": (lambda path: path.write_text("Dear Sir,"), "not a picture"),
    "laughs.svg": (
        lambda path: path.write_text(
            f'<!DOCTYPE svg [<!ENTITY l0 "ha">{LAUGHS}]><svg xmlns="http://www.w3.org/2000/svg">'
            '<path d="M0 0h9" stroke="black"/><text>&l9;</text></svg>'
        ),
        "cannot be read",
    ),
    "away.svg": (
        lambda path: path.write_text(
            '<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
            '<svg xmlns="http://www.w3.org/2000/svg"><text>&x;</text></svg>'
        ),
        "external entities",
    ),
    "empty.svg": (
        lambda path: path.write_text('<svg xmlns="http://www.w3.org/2000/svg"/>'),
        "no path",
    ),
    "a.png": (lambda path: path.write_bytes(b"OTTO" + bytes(40)), "a font is there to write"),
}


@pytest.mark.parametrize("name", TRAPS)
def test_every_trap_is_told(name, tmp_path):
    make, words = TRAPS[name]
    make(tmp_path / name)
    with pytest.raises(InputError, match=words):
        _parse(tmp_path / name, tmp_path)
    assert not (tmp_path / "sheet.json").exists()


def test_four_inks_are_turned_into_three_colours(tmp_path):
    i, j = np.indices((48, 64))
    inks = np.stack([4 * i, 4 * j % 256, 2 * i + j, 0 * i], axis=-1).astype(np.uint8)
    Image.fromarray(inks, "CMYK").save(tmp_path / "inks.jpg")
    _parse(tmp_path / "inks.jpg", tmp_path)
    sheet = load(tmp_path, tmp_path / "inks.jpg")
    assert sheet.flat.values.shape == (48, 64, 3)
    assert any("CMYK" in note for note in sheet.notes)
