import re
from pathlib import Path

import pytest

from relieffab.catalogue.entries import Entry
from relieffab.catalogue.index import index, verdict
from relieffab.catalogue.rows import DONE, FAILED, row, waiting
from relieffab.catalogue.store import summary
from relieffab.catalogue.task import Fault


def report(**more):
    return {
        "settings": {"size": "120x90mm", "solid": "panel"},
        "model": {"notes": []},
        "batch": {"stage": "make", "seconds": 3.2, "worker": "process 7 on host"},
        "relief": {"depth_mm": 3.0, "file": "relief.tiff"},
        **more,
    }


WHOLE = report(
    programs=[{"seconds": 3600.0}, {"seconds": 1800.0}],
    verification={"ok": True},
    panel={"file": "panel.stl"},
)


def test_a_row_tells_what_the_report_knows():
    made = row(Entry("a b", "m/a.ply", "Inv. 7"), WHOLE, DONE, 2)
    assert made == {
        "name": "a b", "model": "m/a.ply", "note": "Inv. 7", "status": "done", "tries": 2,
        "stage": "make", "seconds": 3.2, "worker": "process 7 on host", "size_mm": [120, 90],
        "depth_mm": 3.0, "cutting_s": 5400.0, "programs": 2, "carves": True,
        "findings": [], "notes": [],
        "files": {
            "report": "a%20b/report.html", "thumbnail": "a%20b/thumbnail.jpg",
            "picture": "a%20b/preview.png", "relief": "a%20b/relief.tiff",
            "panel": "a%20b/panel.stl",
        },
    }  # fmt: skip


def test_layers_alone_have_no_relief_to_link():
    alone = report(batch={"stage": "layers", "seconds": 1, "worker": ""})
    del alone["relief"]
    made = row(Entry("a", "a.ply"), alone, DONE)
    assert made["depth_mm"] is None
    assert made["files"]["drawing"] == "a/layers/lines.svg"
    assert verdict(made) == "layers only"


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({}, "relief only"),
        ({"verification": {"ok": True}}, "carves the relief"),
        ({"verification": {"ok": False}}, "does not carve the relief"),
        ({"panel": {"file": "p.stl", "findings": ["too steep"]}}, "has findings"),
    ],
)
def test_a_verdict_in_few_words(more, told):
    stage = {"stage": "make" if more else "relief", "seconds": 1, "worker": ""}
    assert verdict(row(Entry("a", "a.ply"), report(batch=stage, **more), DONE)) == told


def test_the_page_holds_every_job_in_its_place_and_escapes_what_others_wrote():
    evil = '<script>alert("x")</script>'
    entries = [Entry("fine", "a.ply", evil), Entry("bad", evil), Entry("later", "c.ply")]
    rows = [
        row(entries[0], WHOLE, DONE),
        row(entries[1], Fault(f"the model is no model\n  found: {evil}\n  try: another"), FAILED),
        waiting(entries[2]),
    ]
    page = index(summary(Path("scans"), "make", rows, 1.0))
    assert evil not in page
    assert page.count("<article ") == 2
    assert page.index('id="cards"') < page.index("fine/report.html") < page.index('id="failed"')
    assert (
        page.index('id="failed"') < page.index("the model is no model") < page.index("try: another")
    )
    assert page.index('id="waiting"') < page.index("later")
    assert "1 h 30 min to cut" in page
    assert "<b>1</b> of 3 made" in page


def test_the_page_takes_nothing_from_elsewhere():
    page = index(summary(Path("s"), "make", [row(Entry("a", "a.ply"), WHOLE, DONE)], 1.0))
    links = re.findall(r'(?:href|src)="([^"]*)"', page)
    assert links
    assert all(link.startswith(("a/", "#", "batch.json")) for link in links)
    assert not re.search(r"https?:|@import|url\(", page)


def test_a_size_may_have_been_typed_in_inches():
    typed = {**WHOLE, "settings": {"size": "4x3in", "solid": "panel"}}
    assert row(Entry("a", "a.ply"), typed, DONE)["size_mm"][0] == 101.6
