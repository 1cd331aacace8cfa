import os
import select
import threading

import pytest
import serial

from relieffab.errors import InputError, MachineError
from relieffab.grbl import port as port_module
from relieffab.grbl.handlers.protocol_sim import Serial as SimulatedSerial
from relieffab.grbl.port import Found, SerialPort, open_port, ports
from relieffab.grbl.sender import Company, send
from relieffab.grbl.stage import Patience

pty = pytest.importorskip("pty")
tty = pytest.importorskip("tty")


class PtyMachine:
    """The simulator at the far end of a pseudo terminal, twenty times as fast as life."""

    def __init__(self):
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.name = os.ttyname(self.slave)
        self.simulated = SimulatedSerial("sim://?speed=20&boot=0.5", timeout=0.02)
        self.stopping = threading.Event()
        self.thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self):
        self.simulated.open()
        self.thread.start()
        return self

    def _serve(self):
        while not self.stopping.is_set():
            if select.select([self.master], [], [], 0)[0]:
                self.simulated.write(os.read(self.master, 4096))
            if data := self.simulated.read(256):
                os.write(self.master, data)

    def __exit__(self, *exc):
        self.stopping.set()
        self.thread.join(5.0)
        os.close(self.master)
        os.close(self.slave)


def test_a_job_through_a_real_posix_port():
    with PtyMachine() as machine, open_port(machine.name) as port:
        assert isinstance(port.device, serial.Serial)
        report = send(
            "G21\nM3S1000\n" + "".join(f"G1X{i}F1500\n" for i in range(1, 25)) + "M5", port
        )
        assert report.lines == 27
        assert machine.simulated.machine.path == [(float(i), 0.0, 0.0) for i in range(1, 25)]
        assert machine.simulated.machine.lost == 0


def test_an_error_through_a_real_posix_port():
    with PtyMachine() as machine, open_port(machine.name) as port:
        with pytest.raises(MachineError, match="line 3: G1X") as caught:
            send("M3S1000\nG1X1F900\nG1X2Y1X3\nG1X9\n", port)
        assert "error:25" in str(caught.value)
        assert machine.simulated.machine.spindle == 0


LONG = "M3S1000\nG0Z5\n" + "".join(f"G1X{i % 9}Y{i // 9}F900\n" for i in range(900))


def pull(machine, after):
    """Close the far end once the machine is at work."""

    def show(view):
        if view.line > after and not machine.stopping.is_set():
            machine.stopping.set()
            machine.thread.join(5.0)
            os.close(machine.master)
            os.close(machine.slave)
            machine.master, machine.slave = os.open(os.devnull, 0), os.open(os.devnull, 0)

    return show


def test_a_pulled_cable_on_a_real_posix_port_is_told_with_the_line():
    with PtyMachine() as machine, open_port(machine.name) as port:
        with pytest.raises(MachineError, match="connection to the machine was lost") as caught:
            send(LONG, port, Company(show=pull(machine, 8)), patience=Patience(reconnect=0.2))
        assert "switch it off by hand" in str(caught.value)
        assert "--from-line" in str(caught.value)


def test_a_cable_put_back_lets_the_machine_be_stopped(tmp_path):
    name = tmp_path / "router"
    with PtyMachine() as first, PtyMachine() as second:
        name.symlink_to(first.name)
        pulled = pull(first, 8)

        def show(view):
            pulled(view)
            if first.stopping.is_set() and str(name.readlink()) != second.name:
                name.unlink()
                name.symlink_to(second.name)

        second.simulated.machine.spindle = 1000.0
        with open_port(str(name)) as port, pytest.raises(MachineError) as caught:
            send(LONG, port, Company(show=show), patience=Patience(reconnect=5.0))
        assert "its spindle is off" in str(caught.value)
        assert "not to be trusted" in str(caught.value)
        assert second.simulated.machine.spindle == 0


def test_a_second_sender_is_kept_off_the_port():
    with (
        PtyMachine() as machine,
        open_port(machine.name),
        pytest.raises(MachineError, match="close the other program"),
    ):
        open_port(machine.name)


def test_a_port_that_goes_away_is_a_machine_error():
    master, slave = pty.openpty()
    with open_port(os.ttyname(slave)) as port:
        os.close(master)
        os.close(slave)
        with pytest.raises(MachineError, match=r"(reading|writing).*failed"):
            for _ in range(50):
                port.write(b"?")
                port.read()


def test_a_port_that_is_not_there(monkeypatch):
    monkeypatch.setattr(port_module, "ports", lambda: [Found("/dev/ttyACM7", "a router")])
    with pytest.raises(MachineError, match="ttyACM7") as caught:
        open_port("/dev/no-such-port")
    assert caught.value.exit_status == 3
    monkeypatch.setattr(port_module, "ports", list)
    with pytest.raises(MachineError, match="plug the machine in"):
        open_port("/dev/no-such-port")


@pytest.mark.parametrize(
    ("error", "hint"),
    [("[Errno 13] Permission denied", "dialout"), ("[Errno 16] resource busy", "other program")],
)
def test_what_to_do_about_a_port_that_does_not_open(monkeypatch, error, hint):
    def refuse(*args, **options):
        raise serial.SerialException(error)

    monkeypatch.setattr(serial, "serial_for_url", refuse)
    with pytest.raises(MachineError, match=hint):
        open_port("/dev/ttyUSB0")


def test_an_unknown_scheme_is_bad_input():
    with pytest.raises(InputError, match="not a port"):
        open_port("nosuch://x")
    with pytest.raises(InputError, match="did you mean speed"):
        open_port("sim://?sped=1")


@pytest.mark.parametrize("action", ["read", "write", "close"])
def test_every_use_of_a_broken_device_is_explained(action):
    class Broken:
        in_waiting = 0

        def read(self, size):
            raise serial.SerialException("device disconnected")

        def write(self, data):
            raise OSError(5, "Input/output error")

        def close(self):
            raise OSError(9, "Bad file descriptor")

    port = SerialPort("COM9", Broken())
    calls = {"read": port.read, "write": lambda: port.write(b"x"), "close": port.close}
    with pytest.raises(MachineError, match="COM9 failed"):
        calls[action]()


def test_listing_ports_gives_names():
    assert all(isinstance(found.device, str) for found in ports())
