from relieffab.job.sheet.checklist import checklist, zero
from relieffab.stock import Stock


def test_what_there_is_to_do_is_told_in_order(report):
    report["aids"].append({"file": "00-probe.nc", "sha256": "c" * 64})
    steps = checklist(report, Stock(120, 90, 12))
    assert steps[0].startswith("Stock: Softwood")
    assert "12 mm out of it" in steps[2]
    assert [step.split()[0] for step in steps[4:6]] == ["00-outline.nc", "00-probe.nc"]
    assert steps[-1].startswith("After each change")
    report["programs"] = report["programs"][:1]
    assert not any(step.startswith("After each") for step in checklist(report, Stock(9, 9, 9)))


def test_without_programs_there_is_nothing_to_do():
    assert checklist({}, Stock(120, 90, 12)) == []


def test_work_zero_in_words():
    assert zero(Stock(120, 90, 12)) == "the stock's near left corner, on the stock's face"
    assert zero(Stock(120, 90, 12, (60, 45, -12))) == (
        "60 mm right and 45 mm up from the stock's near left corner, under the stock, on the table"
    )
