import pytest

from relieffab.grbl.lines import dwell_seconds, pauses, stores


@pytest.mark.parametrize(
    ("line", "alone"),
    [("G10L2P1X0", True), ("G28.1", True), ("G30.10", True), ("G90G10L20P1Z0", True),
     ("$110=900", True), ("$N0=G21", True), ("G10.0L2P1", True), ("G10.1", False),
     ("G28", False), ("G1X10", False), ("G100", False), ("X28.1", False)],
)  # fmt: skip
def test_lines_that_write_the_eeprom(line, alone):
    assert stores(line) is alone


@pytest.mark.parametrize(
    ("line", "seconds"),
    [("G4P2.5", 2.5), ("P1G04", 1.0), ("G4.0P+2", 2.0), ("G1X1", 0.0), ("G43.1Z1", 0.0)],
)
def test_dwell(line, seconds):
    assert dwell_seconds(line) == seconds


@pytest.mark.parametrize(
    ("line", "waits"), [("M0", True), ("G1X1M00", True), ("M03", False), ("M0.5", False)]
)
def test_pauses(line, waits):
    assert pauses(line) is waits
