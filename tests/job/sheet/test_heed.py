from dataclasses import replace

from relieffab import profiles
from relieffab.job.sheet.heed import heeds


def test_the_gravest_comes_first_and_nothing_twice(report):
    report["relief"]["converged"] = False
    report["mould"] = {"findings": ["a cast will not come free"], "watertight": True}
    report["verification"]["notes"] = ["01-rough.nc was changed"] * 2
    found = heeds(report)
    assert [heed.kind for heed in found] == ["finding", "warning", "warning", "warning", "note"]
    assert found[0].text == "a cast will not come free"
    assert found[1].text.startswith("the relief was not solved")
    assert found[-1].text == "turned outward"


def test_programs_that_do_not_carve_are_a_reason_to_stop(report):
    report["verification"] |= {"ok": False}
    assert ("finding", "the programs do not carve the relief") in heeds(report)
    report["verification"]["findings"] = ["a gouge of 0.3 mm"]
    assert [heed for heed in heeds(report) if heed.kind == "finding"] == [
        ("finding", "a gouge of 0.3 mm")
    ]


def test_a_cutter_that_does_not_stand_out_far_enough_is_told(report):
    short = replace(profiles.cutter("flat-3.175"), flute_length=4.0, stickout=5.0)
    report["programs"][0]["cutter"] = vars(short)
    assert any("5 mm out of its collet" in heed.text for heed in heeds(report))


def test_of_a_report_of_layers_there_is_little_to_heed():
    assert heeds({"model": {"notes": []}}) == []
    assert heeds({"stock": {"note": "no cadquery"}}) == [("note", "no stock.step: no cadquery")]
