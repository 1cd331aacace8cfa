import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.grbl.messages import (
    LONGEST_LINE,
    Acknowledgement,
    Alarm,
    Banner,
    LineSplitter,
    Note,
    Other,
    Setting,
    Status,
    parse,
)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("ok", Acknowledgement(0)),
        ("error:24", Acknowledgement(24)),
        ("ALARM:2", Alarm(2)),
        ("Grbl 1.1h ['$' for help]", Banner("1.1h")),
        ("GrblHAL 1.1f ['$' or '$HELP' for help]", Banner("1.1f", hal=True)),
        ("\x00\x1fGrbl 1.1h ['$' for help]", Banner("1.1h")),
        ("$110=1600.000", Setting(110, 1600.0)),
        ("[OPT:V,15,128]", Note("OPT", "V,15,128")),
        (
            "<Run|MPos:1.000,2.000,-0.500,-33.500|Bf:99,1023|FS:300,0|WCO:0.000,0.000,5.000,90.000>",
            Status(
                "Run",
                machine=(1, 2, -0.5, -33.5),
                offset=(0, 0, 5, 90),
                blocks_free=99,
                bytes_free=1023,
                feed=300,
                speed=0,
            ),
        ),
    ],
)
def test_lines_are_read(line, message):
    assert parse(line) == message


@pytest.mark.parametrize(
    "line",
    [
        ">G21:ok", ">:error:7", "[MSG:ok]", "okk", " ok", "o\ufffdk", "ok ", "OK", "error:",
        "error:x", "<Idle", "<Idle|MPos:1,2|FS:0,0>",
        "<Idle|MPos:1.0,2.0,x|FS:0,0>", "", "$1=x", "$1=.",
    ],
)  # fmt: skip
def test_nothing_else_acknowledges(line):
    assert isinstance(parse(line), (Other, Note))


def test_a_status_report_is_read_in_full():
    status = parse("<Hold:1|MPos:1.000,-2.500,0.125|Bf:13,97|FS:500,8000|WCO:0.000,1.000,2.000>")
    assert status == Status(
        "Hold", 1, (1.0, -2.5, 0.125), None, (0.0, 1.0, 2.0), 13, 97, 500.0, 8000.0
    )
    assert not status.stopped


@pytest.mark.parametrize(
    ("state", "stopped"),
    [("Idle", True), ("Hold:0", True), ("Hold:1", False), ("Run", False), ("Door:3", False),
     ("Door:0", True), ("Alarm", True), ("Jog", False), ("Home", False)],
)  # fmt: skip
def test_which_states_stand_still(state, stopped):
    assert parse(f"<{state}|WPos:0,0,0|F:0>").stopped is stopped


@given(st.lists(st.text("ok<>|:AZ19 ", max_size=9), max_size=8), st.data())
def test_lines_survive_any_chunking(lines, data):
    stream = "".join(line + "\r\n" for line in lines).encode("ascii")
    splitter, got, at = LineSplitter(), [], 0
    while at < len(stream):
        size = data.draw(st.integers(1, 7))
        got += splitter.feed(stream[at : at + size])
        at += size
    assert got == lines


def test_noise_without_line_ends_does_not_pile_up():
    splitter = LineSplitter()
    for _ in range(100):
        assert splitter.feed(b"\xff" * 1000) == []
    assert len(splitter.feed(b"\n")[0]) == LONGEST_LINE


@given(st.text(max_size=40))
def test_no_line_whatever_breaks_the_reader(line):
    parse(line)
    parse("<" + line + ">")
    parse("$" + line)


def test_inches_are_of_lengths_and_degrees_stay():
    status = parse("<Idle|MPos:1.0000,0.0000,-0.5000,90.000|FS:10,0>").in_mm()
    assert status.machine == pytest.approx((25.4, 0.0, -12.7, 90.0))
