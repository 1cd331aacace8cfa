"""The studio as a person starts and ends it."""

import contextlib
import os
import signal
import socket
import subprocess
import sys
import threading
import time

import httpx2
import pytest

from relieffab.cli.main import run
from relieffab.errors import InputError
from relieffab.studio.frames import unpack
from relieffab.studio.serve import listening

SMALL = ["--size", "40x30mm", "--margin", "3mm", "--depth", "1.5mm", "--up", "y"]


@pytest.fixture
def started(ball, tmp_path):
    """A studio in a process of its own; its scratch files go to a folder that is looked at."""
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    command = [sys.executable, "-m", "relieffab", "studio", str(ball), *SMALL, "--no-browser"]
    process = subprocess.Popen(
        [*command, "-o", str(tmp_path / "jobs")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(scratch)},
    )
    yield process, process.stdout.readline().strip(), scratch
    process.kill()
    process.wait()
    process.stdout.close()
    process.stderr.close()


def listen(address, begun):
    """Follow the events until the studio ends them, as the page does."""
    with httpx2.stream("GET", address + "events", timeout=120) as stream:
        for line in stream.iter_lines():
            if '"layers"' in line:
                begun.set()


def upload(address):
    """Send a model that never comes to its end."""

    def drops():
        while True:
            yield b"v 0 0 0\n"
            time.sleep(0.05)

    with contextlib.suppress(httpx2.HTTPError):
        httpx2.post(address + "model", params={"name": "slow.obj"}, content=drops(), timeout=120)


def test_it_serves_a_page_and_ctrl_c_ends_it_and_all_it_began(started, tmp_path):
    process, address, scratch = started
    assert address.startswith("http://127.0.0.1:")
    answer = httpx2.post(address + "preview", json={"ask": 1, "want": ["layers"]}, timeout=300)
    assert unpack(answer.content)[0]["ask"] == 1
    assert httpx2.get(address.replace("127.0.0.1", "localhost") + "state").status_code == 200
    assert httpx2.get(address + "state", headers={"host": "evil.example"}).status_code == 421
    assert httpx2.get(address[:-2] + "/state").status_code == 404
    begun = threading.Event()
    others = [
        threading.Thread(target=listen, args=(address, begun)),
        threading.Thread(target=upload, args=(address,)),
    ]
    for other in others:
        other.start()
    assert httpx2.post(address + "export", json={}).status_code == 202
    assert begun.wait(120)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    for other in others:
        other.join(30)
    assert process.returncode == 0, said
    assert "Traceback" not in said
    assert list(scratch.iterdir()) == []
    assert [path for path in tmp_path.rglob("*") if path.name != "scratch"] == []


def test_it_listens_on_this_computer_alone():
    with listening(0) as taken:
        host, port = taken.getsockname()
        assert host == "127.0.0.1" and port > 0


def test_a_port_in_use_is_told(capsys, tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        assert run(["studio", "--port", str(port), "-o", str(tmp_path), "--no-browser"]) == 2
    told = capsys.readouterr().err
    assert f"port {port} is in use by another program" in told
    assert "Traceback" not in told


def test_a_port_that_is_none_is_told():
    for port in (-1, 70000):
        with pytest.raises(InputError, match="cannot be taken"):
            listening(port)


def test_a_bad_model_or_setting_ends_it_at_once(capsys, tmp_path):
    letter = tmp_path / "letter.stl"
    letter.write_text("Dear Sir")
    for words in ([str(letter)], ["--depth", "deep"], [str(tmp_path / "nothing.ply")]):
        assert run(["studio", *words, "-o", str(tmp_path), "--no-browser"]) == 2
    assert "no faces" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == [letter]


def test_settings_that_say_nothing_of_the_model_end_it_at_once(capsys, bump, ball, tmp_path):
    for words, told in (
        ([str(bump), "--azimuth", "30deg"], "--azimuth says nothing of a model of this kind"),
        ([str(ball), "--mask", str(bump)], "--mask says nothing of a model of this kind"),
        (["--mask", str(bump)], "only a picture has a mask"),
    ):
        assert run(["studio", *words, "-o", str(tmp_path / "jobs"), "--no-browser"]) == 2
        assert told in capsys.readouterr().err
