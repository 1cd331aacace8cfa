import base64
import re
import zlib

import numpy as np
import pytest

from relieffab.stock import Stock
from relieffab.template.model import make_template
from relieffab.template.pdf import pages_of, to_pdf


@pytest.fixture
def template(bowl, strokes):
    return make_template(bowl, strokes, Stock(60.0, 40.0, 12.0), name="Schüssel 馬.ply")


def streams(data):
    found = re.findall(rb"ASCII85Decode /FlateDecode.*?stream\r?\n(.*?)endstream", data, re.DOTALL)
    return [zlib.decompress(base64.a85decode(b"<~" + one.strip(), adobe=True)) for one in found]


def boxes(data):
    return re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", data)


def test_the_same_template_gives_the_same_bytes(template):
    data = to_pdf(template, "a4")
    assert data == to_pdf(template, "a4")
    assert data.startswith(b"%PDF-")


@pytest.mark.parametrize(("paper", "size"), [("a4", (210, 297)), ("letter", (215.9, 279.4))])
def test_the_page_is_the_paper(template, paper, size):
    (box,) = boxes(to_pdf(template, paper))
    assert [float(side) / 72 * 25.4 for side in box] == pytest.approx(size, abs=1e-3)


def test_the_bar_measures_100_mm_on_every_page(bowl, strokes):
    template = make_template(bowl, strokes, Stock(360.0, 300.0, 12.0))
    data = to_pdf(template, "a4")
    assert len(boxes(data)) == len(pages_of(template, "a4").pages()) == 4
    pages = [text for text in streams(data) if b" of B2" in text]
    assert {re.search(rb"\(([AB][12] of B2)\)", text)[1] for text in pages} == {
        b"A1 of B2", b"A2 of B2", b"B1 of B2", b"B2 of B2",
    }  # fmt: skip
    for text in pages:
        scale = float(re.search(rb"(\d+\.\d+) 0 0 \1 0 0 cm", text)[1])
        lines = re.findall(rb"n ([\d.]+) ([\d.]+) m ([\d.]+) ([\d.]+) l\s+S", text)
        x0, y0, x1, y1 = np.array(lines, float).T * scale / 72 * 25.4
        level = x1[y0 == y1] - x0[y0 == y1]
        assert level.max() == pytest.approx(100.0, abs=1e-3)


def test_every_page_shows_the_drawing_that_is_in_the_file_once(bowl, strokes):
    one = to_pdf(make_template(bowl, strokes, Stock(60.0, 40.0, 12.0)), "a4")
    many = to_pdf(make_template(bowl, strokes, Stock(360.0, 300.0, 12.0)), "a4")
    assert sum(b"Do" in text for text in streams(many)) == 4
    assert len(many) < 2 * len(one)
