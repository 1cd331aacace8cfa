import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from relieffab.cli.main import run
from relieffab.grbl import port as port_module
from relieffab.grbl.port import Found

FAST = "sim://?speed=max&boot=0.1"
TEXT = "G21G90\nM3S1000\nG0X0Y0Z5\nF900\n" + "".join(
    f"G1X{i % 20 * 0.3:.1f}Y{i // 20 * 0.3:.1f}Z-{i % 7 * 0.1:.1f}\n" for i in range(300)
)


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "job.nc"
    path.write_text(TEXT + "G0Z5\nM5\nM30\n")
    return path


def send(program, *more, port=FAST):
    return run(["send", str(program), "--port", port, *more])


def test_it_says_what_it_will_do_and_what_was_done(program, capsys):
    assert send(program) == 0
    told = capsys.readouterr()
    assert told.out == "carved 189 mm in 307 lines\n"
    assert "X 0.000..5.700  Y 0.000..4.200  Z -0.600..5.000 mm" in told.err
    assert "about 0:0" in told.err


def test_json(program, capsys):
    assert send(program, "--json") == 0
    assert json.loads(capsys.readouterr().out)["lines"] == 307


def test_the_log_and_the_record(program, own_state, tmp_path, capsys):
    assert send(program, "--log", str(tmp_path / "job.log")) == 0
    assert (tmp_path / "job.log").read_text().startswith("# relieffab job log 1\n# program ")
    assert list(own_state.glob("*.json")) == []


def test_an_interrupted_job_is_recorded_and_taken_up_again(program, own_state, capsys):
    assert send(program, port=FAST + "&reboot_at=15") == 3
    error = capsys.readouterr().err
    record = json.loads(next(own_state.glob("*.json")).read_text())
    assert f"--from-line {record['line']}" in error
    assert 20 < record["line"] < 290
    assert send(program, "--resume") == 3
    assert "--zero-set" in capsys.readouterr().err
    assert send(program, "--resume", "--zero-set") == 0
    told = capsys.readouterr()
    assert f"at line {record['line']}: up to Z5" in told.err
    assert int(told.out.split()[-2]) == 308 - record["line"]
    assert list(own_state.glob("*.json")) == []
    assert send(program, "--resume") == 2
    assert "not interrupted" in capsys.readouterr().err


@pytest.mark.parametrize("place", [["--from-line", "100"], ["--from-time", "0:15"]])
def test_a_place_in_the_program(program, place, capsys):
    assert send(program, *place) == 3
    assert send(program, *place, "--zero-set") == 0
    assert int(capsys.readouterr().out.split()[-2]) < 250


@pytest.mark.parametrize(
    ("more", "why"),
    [
        (["--from-line", "9999", "--zero-set"], "no such line"),
        (["--from-time", "soon"], "not a time"),
        (["--check", "--trace"], "one"),
        (["--from-line", "9", "--from-time", "9"], "one"),
        (["--probe", "thick"], "not a length"),
    ],
)
def test_what_cannot_be_asked_for(program, more, why, capsys):
    assert send(program, *more) == 2
    assert why in capsys.readouterr().err


def test_check_finds_errors_with_their_lines(program, capsys):
    assert send(program, "--check") == 0
    assert "read 307 lines, 0 refused" in capsys.readouterr().out
    program.write_text(TEXT + "G1X1Y2X3\nM6\n")
    assert send(program, "--check") == 1
    assert "line 305: G1X1Y2X3: error:25" in capsys.readouterr().err


def test_trace_and_probe_leave_the_program_alone(program, own_state, capsys):
    assert send(program, "--trace") == 0
    assert send(program, "--probe", "15mm", port=FAST + "&plate=-3") == 0
    assert send(program, "--probe", "15mm") == 3
    assert "probe found nothing" in capsys.readouterr().err
    assert not own_state.exists()


def test_a_program_or_a_port_that_is_missing(tmp_path, capsys):
    assert run(["send"]) == 2
    assert run(["send", str(tmp_path / "none.nc"), "--port", FAST]) == 2
    assert "no such program" in capsys.readouterr().err


def test_ports_are_listed(monkeypatch, capsys):
    monkeypatch.setattr(port_module, "ports", lambda: [Found("/dev/ttyUSB0", "CH340")])
    assert run(["send", "--list"]) == 0
    assert capsys.readouterr().out.split() == ["/dev/ttyUSB0", "CH340"]
    assert run(["send", "--list", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == [
        {"device": "/dev/ttyUSB0", "description": "CH340"}
    ]


def test_what_holds_the_machine_is_told_by_name(program, capsys):
    assert send(program, port=FAST + "&door_at=5&door_s=3") == 3
    told = capsys.readouterr().err
    assert "the safety door is open: the spindle is off" in told
    assert "the safety door is closed again" in told


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.usefixtures("heard")
def test_a_stop_from_outside_stops_the_machine_and_says_where(program, number, tmp_path):
    log = tmp_path / "job.log"
    command = [sys.executable, "-m", "relieffab", "send", str(program), "--log", str(log)]
    process = subprocess.Popen(
        [*command, "--port", "sim://?speed=4&boot=0.1"], stderr=subprocess.PIPE, text=True,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
    )  # fmt: skip
    for _ in range(600):
        if log.is_file() and "G1X0.9" in log.read_text():
            break
        time.sleep(0.05)
    process.send_signal(number)
    error = process.communicate(timeout=60)[1]
    assert process.returncode == 130
    assert "its spindle is off" in error
    assert "--from-line" in error
    assert log.read_text().count("> !") == 1
