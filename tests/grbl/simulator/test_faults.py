import math

import pytest

from relieffab.grbl.handlers.protocol_sim import Serial, read_url
from relieffab.grbl.simulator.faults import Faults, Noise


def opened(url):
    port = Serial(None, timeout=0.05)
    port.port = url
    port.open()
    return port


def wait(port, until):
    got = b""
    while port.now() < until:
        got += port.read(500)
    return got


def test_a_clean_line_alters_nothing():
    data = bytes(range(256)) * 40
    assert Noise(Faults()).spoil(data, 0.0) == data


def test_noise_is_as_frequent_as_asked_for_and_always_the_same():
    data = bytes(100) * 200
    runs = []
    for _ in range(2):
        noise = Noise(Faults(flip=0.01, drop=0.02, seed=5))
        runs.append(noise.spoil(data, 0.0))
        lost = len(data) - len(runs[-1])
        flipped = sum(byte != 0 for byte in runs[-1])
        assert noise.hits == lost + flipped
        assert lost == pytest.approx(400, rel=0.2)
        assert flipped == pytest.approx(200, rel=0.3)
        assert {byte.bit_count() for byte in runs[-1]} == {0, 1}
    assert runs[0] == runs[1]
    assert Noise(Faults(drop=1.0, noise_at=2.0)).spoil(b"ab", 1.9) == b"ab"
    assert Noise(Faults(drop=1.0, noise_at=2.0)).spoil(b"ab", 2.0) == b""


def test_a_pulled_cable_fails_and_the_machine_goes_on_until_it_is_back():
    url = "sim://?speed=max&boot=0.1&unplug_at=1"
    port = opened(url)
    wait(port, 0.5)
    port.write(b"M3S100\nG1X10F600\n")
    with pytest.raises(OSError, match="disconnected"):
        wait(port, 2.0)
    with pytest.raises(OSError, match="disconnected"):
        port.write(b"!")
    machine = port.machine
    again = opened(url)
    assert again.machine is machine
    assert machine.path == [(10.0, 0.0, 0.0)]
    assert b"Grbl 1.1h" in wait(again, again.now() + 1)
    assert machine.planner.position == (0.0, 0.0, 0.0)
    assert opened(url).machine is not machine


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        ("reboot_at=1", b"Grbl 1.1h"),
        ("limit_at=1", b"ALARM:1"),
        ("door_at=1", b"[MSG:Check Door]"),
        ("stray_at=1", b"ok"),
    ],
)
def test_what_happens_at_its_time(fault, said):
    port = opened("sim://?speed=max&boot=0.1&" + fault)
    assert said not in wait(port, 0.9).partition(b"help]")[2]
    assert said in wait(port, 1.5)


def test_a_hold_and_silence():
    port = opened("sim://?speed=max&boot=0.1&hold_at=1&mute_at=2")
    wait(port, 1.2)
    port.write(b"?")
    assert b"Hold:0" in wait(port, 1.6)
    wait(port, 2.1)
    port.write(b"?")
    assert wait(port, 3.0) == b""


def test_the_url_names_them():
    assert read_url("sim://")["faults"] == Faults()
    faults = read_url("sim://?flip=1e-4&seed=9&door_at=3&door_s=1")["faults"]
    assert faults == Faults(flip=1e-4, seed=9, door_at=3, door_s=1)
    assert faults.unplug_at == math.inf
