import re
from html.parser import HTMLParser

import numpy as np
import pytest

from relieffab.job.report import start_report
from relieffab.job.settings import resolve
from relieffab.job.sheet.page import page
from relieffab.picture import png8

VOID = {"meta", "img", "input", "image", "path", "br"}


class Tags(HTMLParser):
    """Every element that is opened is closed again, in order."""

    def __init__(self):
        super().__init__()
        self.open, self.seen, self.links = [], [], []

    def handle_starttag(self, tag, attrs):
        self.seen.append(tag)
        self.links += [value for name, value in attrs if name in ("src", "href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag


def parsed(text):
    tags = Tags()
    tags.feed(text)
    assert tags.open == []
    return tags


def test_a_whole_job_has_all_that_the_machine_asks(report):
    text = page(report)
    tags = parsed(text)
    assert tags.seen.count("article") == 2
    assert tags.seen.count("svg") == 2
    for words in (
        "Setup sheet",
        "1 h 00 min",
        "<b>12 mm</b> or more out of the collet",
        "1,000 mm/min",
        "Unverified",
        "feeds are a careful guess",
        f"{1:064x}  01-rough.nc",
        f"{'a' * 64}  relief.tiff",
        "make </span>",
        "00-outline.nc run",
    ):
        assert words in text
    assert text.index("careful guess: start slower") < text.index("The stock and work zero")


def test_it_asks_for_nothing_outside_itself(tmp_path, report):
    report["picture"] = {"file": "preview.png", "method": "hillshade"}
    (tmp_path / "preview.png").write_bytes(png8(np.zeros((4, 4), np.uint8)))
    links = parsed(page(report, [tmp_path])).links
    assert len(links) == 1
    assert all(link.startswith("data:image/") for link in links)
    assert "url(" not in page(report)


@pytest.mark.parametrize("name", ["<script>alert(1)</script>", '"><img src=x onerror=y>', "a&b"])
def test_what_people_typed_stays_text(name, made):
    report = made(model=name)
    report["model"]["name"] = name
    report["model"]["notes"] = [name]
    report["programs"][0]["cutter"]["title"] = name
    report["reliefs"] = [{"model": {"name": name}, "place_mm": [0, 0]}]
    text = page(report)
    assert name not in text
    assert not {"script", "img"} & set(parsed(text).seen)


def test_a_verdict_against_the_programs_cannot_be_missed(report):
    report["verification"] |= {"ok": False, "findings": ["a gouge of 0.3 mm"]}
    text = page(report)
    assert "DOES NOT carve" in text
    assert re.search(r'class="finding"><b>Stop</b> <span>a gouge of 0.3 mm', text)


def test_positions_have_a_drawing_each(report):
    for number, part in enumerate(report["programs"], 1):
        part["position"] = {
            "number": number,
            "count": 2,
            "low": [0.0, 0.0],
            "high": [120.0, 90.0],
            "zero": [0.0, 0.0],
            "turned": number == 2,
        }
        part["placing"] = "as it lies" if number == 1 else "turn it half round"
    text = page(report)
    assert parsed(text).seen.count("svg") == 3
    assert "Position 2 of 2: turn it half round" in text


def test_jobs_of_one_stage_have_a_page_too():
    report = start_report(resolve([]))
    report["model"] = {"name": "cow", "notes": []}
    text = page(report)
    assert "Setup sheet" not in text
    assert "relieffab" in text
    mould = {"files": ["mould.stl"], "triangles": 10, "watertight": True, "volume_mm3": 1.0}
    mould |= {"max_error_mm": 0.0, "draft": {"least_deg": 2.0, "asked_deg": 3.0}}
    mould |= {"findings": ["a cast will not come free"]}
    template = {"file": "t.pdf", "pages": 2, "paper": "a4", "contour_step_mm": 0.6}
    text = page({**report, "mould": mould, "template": template})
    parsed(text)
    assert "2 pages of a4" in text
    assert "2.00°, 3° asked" in text
    assert "a cast will not come free" in text


@pytest.mark.parametrize(
    ("machine", "words"),
    [
        ("altmill-4x4-rotary", ["A, °", "<td>A</td>", "turns so as A grows", "A 0: the stock"]),
        ("3018-prover-rotary", ["Y, mm", "<td>Y</td>", "turns so as Y grows", "$101 is its steps"]),
    ],
)
def test_a_round_stock_is_shown_as_it_turns(machine, words, made):
    text = page(made(round="40mm", bore="10mm", size="60x45mm", machine=machine))
    assert parsed(text).seen.count("svg") == 3
    common = ["round, 40 mm thick, 45 mm long, bored 10 mm wide", "no end", "figure&#39;s top"]
    for word in [*words, *common]:
        assert word in text


@pytest.mark.parametrize(
    ("form", "count", "words"),
    [
        ({"round": "40mm"}, 3, "round, 40 mm thick, 45 mm long"),
        ({"curved": "120mm"}, 1, "its face curved along X with a radius of 120 mm"),
    ],
)
def test_a_bent_panel_without_programs_has_a_page(form, count, words):
    report = start_report(resolve([("flag", {"size": "60x45mm", **form})]))
    report["model"] = {"name": "cow", "notes": []}
    text = page(report)
    assert parsed(text).seen.count("svg") == count
    assert words in text


def styled(report, **places):
    """The report of a job with marks: (spacing, depth) of each place, mm, None where none are."""
    measured = {
        place: {
            "spacing_mm": spacing,
            "depth_mm": depth,
            "area_mm2": 90.0,
            "within_tolerance": 0.9994,
            "left_p99_mm": 0.039,
            "tolerance_mm": 0.05,
        }
        for place, (spacing, depth) in places.items()
    }
    cutter = report["programs"][1]["cutter"]
    asked = {"spacing_mm": 1.0, "depth_mm": 0.13, "cutter": cutter, "strokes": 1041}
    return report | {"style": {**asked, "measured": measured}}


def cells(text):
    """The cells of the table of marks, row by row, without their tags."""
    table = re.search(r"<h2>Marks</h2>.*?</table>", text, re.DOTALL)[0]
    rows = re.findall(r"<tr>(.*?)</tr>", table)
    return [[c.strip() for c in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row)] for row in rows]


def test_marks_are_told_as_asked_and_as_they_came_out(report):
    text = page(styled(report, figure=(0.7844, 0.1385), ground=(None, 0.2)))
    parsed(text)
    assert "1,041 strokes by <code>tapered-ball-1</code>" in text
    left = ["99.9 % within 0.05 mm", "0.039"]
    assert cells(text)[1:] == [
        ["Asked", "1", "0.13", "", ""],
        ["On the figure", "0.78", "0.14", *left],
        ["On the ground", "", "0.20", *left],
    ]


def test_a_place_with_no_room_for_marks_says_so(report):
    text = page(styled(report, figure=(None, None)))
    assert cells(text)[2] == ["On the figure", "none: there is no room for one"]


def test_without_marks_there_is_no_section_of_them(report):
    assert "<h2>Marks</h2>" not in page(report)
