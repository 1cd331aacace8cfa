import pytest

from relieffab.errors import InputError
from relieffab.layers.art.runs import Run, runs_of

ALEF, BEH, SIGN = "\u05d0", "\u0628", "\U00013000"


@pytest.mark.parametrize(
    ("line", "runs"),
    [
        ("", []),
        ("12.5", [("12.5", False)]),
        ("(AB) 12", [("(AB) 12", False)]),
        (f"AB {SIGN}.", [("AB ", False), (f"{SIGN}.", False)]),
        ("A\u0301\u03b1", [("A\u0301", False), ("\u03b1", False)]),
        (f"{ALEF}-{ALEF}", [(f"{ALEF}-{ALEF}", True)]),
        (f"{ALEF} 12.5, {ALEF}", [(f", {ALEF}", True), ("12.5", False), (f"{ALEF} ", True)]),
        (f"12 {ALEF}{BEH}", [(BEH, True), (f" {ALEF}", True), ("12", False)]),
        (f"{BEH}\u0661\u0662", [("\u0661\u0662", False), (BEH, True)]),
    ],
)
def test_runs_stand_from_left_to_right(line, runs):
    assert runs_of(line) == [Run(*run) for run in runs]


def test_both_ways_in_one_line_are_refused():
    for line in (f"A{ALEF}", f"{BEH} 12 \u03b1"):
        with pytest.raises(InputError, match="both from left to right"):
            runs_of(line)
