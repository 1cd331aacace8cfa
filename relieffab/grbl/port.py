"""Serial ports: the only module that imports pyserial.

What the operating system or pyserial complain of becomes a MachineError that says what to
do next.
"""

import contextlib
import os
import select
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import serial
from serial.tools import list_ports

from relieffab.errors import InputError, MachineError

try:
    import termios

    _TERMINAL: tuple[type[Exception], ...] = (termios.error,)  # pyserial lets it through
except ImportError:  # Windows
    _TERMINAL = ()

BAUD = 115200
TICK = 0.05
"""Seconds a read waits for the first byte, so that the sender can look at the clock."""

WRITE_TIMEOUT = 5.0
"""Seconds after which a port that takes no bytes counts as lost."""
RETRY = 0.5
"""Seconds between two attempts to open a port that went away."""

_UNOPENED: tuple[type[Exception], ...] = (OSError, *_TERMINAL)
_GONE: tuple[type[Exception], ...] = (TypeError, *_UNOPENED)
"""What a port raises that went away; TypeError: pyserial has closed it already."""

_HANDLERS = "relieffab.grbl.handlers"


class Port(Protocol):
    """What the sender needs of a port."""

    name: str

    def read(self) -> bytes:
        """Give what has come, after a short wait at most; may be empty."""

    def write(self, data: bytes) -> None:
        """Send all of it."""

    def now(self) -> float:
        """Seconds on the clock of the machine behind the port."""

    def reopen(self, patience: float) -> bool:
        """Try for so many seconds to open it again after it went away."""

    def close(self) -> None:
        """Let go."""


@dataclass(frozen=True)
class Found:
    """A port of this computer.

    Parameters
    ----------
    device, description : str
    """

    device: str
    description: str


class SerialPort:
    """A port that pyserial has opened.

    Parameters
    ----------
    name : str
        The device or URL.
    device : serial.SerialBase
        Anything with read, write, in_waiting, close; a `now` of its own replaces the
        computer's clock.
    reopen : callable, optional
        Opens the same device again.
    """

    def __init__(
        self,
        name: str,
        device: serial.SerialBase,
        reopen: Callable[[], serial.SerialBase] | None = None,
    ) -> None:
        self.name = name
        self._reopen = reopen
        self._use(device)

    def _use(self, device: serial.SerialBase) -> None:
        self.device = device
        self.now: Callable[[], float] = getattr(device, "now", time.monotonic)
        handle = getattr(device, "fd", None)
        self._handle: int | None = handle if isinstance(handle, int) else None

    def read(self) -> bytes:
        """Give what has come, waiting up to `TICK` for the first byte."""
        try:
            if self._handle is not None:
                return self._read_posix(self._handle)
            data = self.device.read(1)
            waiting = self.device.in_waiting if data else 0
            return bytes(data + self.device.read(waiting) if waiting else data)
        except _GONE as error:
            raise _lost(f"reading from {self.name} failed", error) from error

    def _read_posix(self, handle: int) -> bytes:
        """Do with two system calls what pyserial does with five: it is done for every `ok`."""
        ready, _, _ = select.select([handle], [], [], TICK)
        if not ready:
            return b""
        data = os.read(handle, 4096)
        if not data:
            raise OSError("the device is gone")
        return data

    def write(self, data: bytes) -> None:
        """Send all of it."""
        try:
            if self._handle is not None:
                data = data[self._write_posix(self._handle, data) :]
            if data:
                self.device.write(data)
        except _GONE as error:  # a time-out of pyserial's is an OSError
            raise _lost(f"writing to {self.name} failed", error) from error

    def _write_posix(self, handle: int, data: bytes) -> int:
        try:
            return os.write(handle, data)
        except BlockingIOError:
            return 0

    def reopen(self, patience: float) -> bool:
        """Try for so many seconds to open the port again after it went away."""
        if self._reopen is None:
            return False
        self._let_go()
        deadline = time.monotonic() + patience
        while True:
            try:
                self._use(self._reopen())
                return True
            except _GONE:
                if time.monotonic() >= deadline:
                    return False
                time.sleep(RETRY)

    def _let_go(self) -> None:
        """Close what may be gone already; what it says about that helps nobody."""
        with contextlib.suppress(*_GONE):
            self.device.reset_output_buffer()
        with contextlib.suppress(*_GONE):
            self.device.close()

    def close(self) -> None:
        """Let go of the port."""
        try:
            self.device.close()
        except _GONE as error:
            raise _lost(f"closing {self.name} failed", error) from error

    def __enter__(self) -> "SerialPort":
        return self

    def __exit__(self, *exc: object) -> None:
        self.close()


def _lost(message: str, error: Exception) -> MachineError:
    return MachineError(
        message,
        found=str(error),
        hint="check the cable; the machine goes on with what it has: watch the spindle",
    )


def open_port(url: str, *, baud: int = BAUD) -> SerialPort:
    """Open a device (``/dev/ttyUSB0``, ``COM3``) or a URL (``sim://?speed=max``).

    Parameters
    ----------
    url : str
    baud : int
        Bits a second.

    Raises
    ------
    MachineError
        If the port is not there, is in use, or may not be opened.
    InputError
        If the URL cannot be read.
    """
    if _HANDLERS not in serial.protocol_handler_packages:
        serial.protocol_handler_packages.append(_HANDLERS)

    def opened() -> serial.SerialBase:
        return serial.serial_for_url(
            url, baudrate=baud, timeout=TICK, write_timeout=WRITE_TIMEOUT, exclusive=True
        )

    try:
        device = opened()
    except ValueError as error:
        raise InputError("this is not a port", found=str(error), where=url) from error
    except _UNOPENED as error:
        raise MachineError(
            f"the port {url} cannot be opened", found=str(error), hint=_why_not(error)
        ) from error
    return SerialPort(url, device, opened)


def _why_not(error: Exception) -> str:
    """Say what to do about a port that does not open."""
    text = str(error).lower()
    if "permission" in text or "access is denied" in text:
        return "close other programs that use the port; on Linux join the group dialout"
    if "busy" in text or "exclusively lock" in text:
        return "close the other program that uses the port"
    names = ", ".join(found.device for found in ports())
    return f"ports found: {names}" if names else "no serial port found: plug the machine in"


def ports() -> list[Found]:
    """List the serial ports of this computer, USB adapters first."""
    found = sorted(list_ports.comports(), key=lambda port: (port.vid is None, port.device))
    return [Found(port.device, port.description or "") for port in found]
