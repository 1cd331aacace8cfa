from math import pi

from relieffab.job.sheet.checklist import checklist
from relieffab.round import Round
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


def of_round(made, machine):
    report = made(round="40mm", size="60x45mm", machine=machine)
    bent = Round(60, 45, 40)
    return " ".join(checklist(report, Stock.of(report["slab"]), bent))


def test_a_stock_that_a_turns_is_chucked_and_its_zero_found(made):
    told = of_round(made, "altmill-4x4-rotary")
    assert "round, 40 mm thick, 45 mm long" in told
    assert "From X 10 to 110 mm, all the way round, nothing of chuck or tailstock" in told
    assert "A 0: the stock turned" in told
    assert "X and A stay" in told
    assert "Clamped" not in told
    assert "$101" not in told


def test_where_y_is_wired_to_the_axis_its_steps_are_those_of_the_face(made):
    told = of_round(made, "3018-prover-rotary")
    assert f"$101 is its steps for a whole turn / {40 * pi:.3f}" in told
    assert f"$111 {3600 / 360 * 40 * pi:.0f} mm/min" in told
    assert "Y 0: the stock turned" in told
