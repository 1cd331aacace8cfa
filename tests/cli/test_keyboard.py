import os
import sys
import termios
from pathlib import Path

import pytest

from relieffab.cli.keyboard import keyboard

pty = pytest.importorskip("pty")


def test_keys_are_read_one_by_one_without_waiting(monkeypatch):
    master, slave = pty.openpty()
    with os.fdopen(slave, "r") as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        monkeypatch.setattr(sys, "stderr", terminal)
        before = termios.tcgetattr(slave)
        with keyboard() as typed:
            assert typed() == ""
            os.write(master, b"!~")
            keys = ""
            while len(keys) < 2:
                keys += typed()
            assert keys == "!~"
        assert termios.tcgetattr(slave) == before
    os.close(master)


def test_without_a_terminal_nobody_types(monkeypatch):
    with Path(os.devnull).open() as nothing:
        monkeypatch.setattr(sys, "stdin", nothing)
        with keyboard() as typed:
            assert typed is None
