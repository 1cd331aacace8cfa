import math
import time

import pytest

from relieffab.errors import InputError
from relieffab.grbl.handlers.protocol_sim import Serial, read_url


def opened(url, **options):
    port = Serial(None, **options)
    port.port = url
    port.open()
    return port


def read_until(port, text, tries=2000):
    got = b""
    for _ in range(tries):
        got += port.read(64)
        if text in got:
            return got
    raise AssertionError(got)


def test_at_full_speed_time_goes_on_only_in_read():
    port = opened("sim://?speed=max", timeout=0.05)
    time.sleep(0.01)
    assert port.now() == 0.0
    assert port.read(1) == b""
    assert port.now() == pytest.approx(0.05)
    begin = time.monotonic()
    assert b"Grbl 1.1h" in read_until(port, b"help]\r\n")
    assert port.now() == pytest.approx(1.6, abs=0.05)
    assert time.monotonic() - begin < 1.6


def test_in_real_time_the_clock_is_the_hosts():
    port = opened("sim://?speed=10&boot=0.5", timeout=0.05)
    before = time.monotonic()
    read_until(port, b"Grbl")
    passed = time.monotonic() - before
    assert passed >= 0.04
    assert port.now() >= 0.5
    assert port.machine.now <= port.now()


def test_sizes_are_kept_to_and_waiting_bytes_counted():
    port = opened("sim://?speed=max", timeout=5.0)
    assert port.read(1) == b"\r"
    assert port.in_waiting > 0
    assert port.read(3) == b"\nGr"
    port.reset_input_buffer()
    assert port.in_waiting == 0


def test_options_reach_the_machine():
    port = opened("sim://?speed=max&$110=500&rx_buffer=64&boot=0", baudrate=9600, timeout=1)
    assert port.machine.settings[110] == 500
    assert port.machine.wire.size == 64
    assert read_url("sim://?speed=max")["speed"] == math.inf
    assert read_url("sim://")["speed"] == 1.0
    assert read_url("sim://?blank=1")["blank"] is True


@pytest.mark.parametrize(
    ("url", "why"),
    [("sim://?sped=max", "did you mean speed"), ("sim://?speed=fast", "number"),
     ("sim://?speed=0", "more than 0"), ("sim://?$x=1", "number")],
)  # fmt: skip
def test_bad_urls_say_why(url, why):
    with pytest.raises(InputError, match=why):
        read_url(url)


def test_waiting_for_ever_on_a_machine_at_rest_is_an_error_not_a_hang():
    port = opened("sim://?speed=max&boot=0", timeout=None)
    read_until(port, b"help]\r\n")
    with pytest.raises(TimeoutError):
        port.read(1)
