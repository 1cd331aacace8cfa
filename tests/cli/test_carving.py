import sys
from dataclasses import replace

import pytest

from relieffab.cli.carving import clock, status_line
from relieffab.grbl.view import View

RUN = View(
    state="Run", meaning="", cut_mm=50.0, total_mm=200.0, left_s=3725.4, position=(1.0, 2.0, -0.5),
    feed=900.0, speed=1000.0, overrides=(100, 100, 100), fill=0.86, line=9,
)  # fmt: skip


@pytest.mark.parametrize(
    ("seconds", "text"), [(0, "0:00:00"), (59.6, "0:01:00"), (36_000, "10:00:00")]
)
def test_times_are_written_as_clocks_show_them(seconds, text):
    assert clock(seconds) == text


def test_the_line_shows_all_of_it(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    with status_line() as show:
        show(RUN)
        show(replace(RUN, overrides=(110, 50, 100)))
        show(replace(RUN, state="Hold:0", meaning="held"))
    shown = capsys.readouterr().err.split("\r\x1b[2K")
    assert shown[1] == (
        "Run   50 of 200 mm (25 %)  1:02:05 left  1.00,2.00,-0.50  F900 S1000  buffer 86%"
    )
    assert "110/50/100 %" in shown[2]
    assert shown[3] == "Hold:0: held\n"


def test_without_a_terminal_only_what_holds_is_told_and_once(capsys):
    with status_line() as show:
        for view in (RUN, replace(RUN, state="Hold:0", meaning="held"), RUN):
            show(view)
            show(view)
    assert capsys.readouterr().err == "Hold:0   held\n"
