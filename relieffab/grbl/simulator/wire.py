"""The serial line into the controller, its receive buffer, and the line out.

Bytes take their time on the wire.  Real-time bytes are picked out as they arrive, wherever
they stand; all others go to a ring buffer that drops what does not fit.
"""

import math
import re
from collections import deque

_REALTIME = re.compile(rb"[\x18!?~\x80-\xff]")
BITS_PER_BYTE = 10


class Wire:
    """Both directions, on the machine's clock.

    Parameters
    ----------
    baud : float
        Bits a second.
    size : int
        Bytes of the receive buffer.

    Attributes
    ----------
    lost : int
        Bytes that found the buffer full, or the controller deaf.
    urgent : deque of (float, int)
        Real-time bytes with the time of their arrival.
    sent : deque of (float, bytes)
        What the controller says, with the time at which it is all out.
    """

    def __init__(self, baud: float, size: int) -> None:
        self.size = size
        self.lost = 0
        self.urgent: deque[tuple[float, int]] = deque()
        self.sent: deque[tuple[float, bytes]] = deque()
        self.deaf_until = 0.0
        self._byte = BITS_PER_BYTE / baud
        self._coming: deque[tuple[float, bytes]] = deque()
        self._free = 0.0
        self._said = 0.0
        self._buffer = bytearray()
        self._line = bytearray()

    def push(self, data: bytes, now: float) -> None:
        """Put bytes on the wire at `now`, behind those that are still on it."""
        begin = max(now, self._free)
        self._free = begin + len(data) * self._byte
        at = 0
        for match in _REALTIME.finditer(data):
            self._queue(data[at : match.start()], begin + at * self._byte)
            at = match.end()
            self.urgent.append((begin + at * self._byte, data[match.start()]))
        self._queue(data[at:], begin + at * self._byte)

    def _queue(self, data: bytes, begin: float) -> None:
        if data:
            self._coming.append((begin, data.replace(b"\r", b"\n")))

    def newline_at(self) -> float:
        """When the next line end arrives; inf where none is on the wire."""
        for begin, data in self._coming:
            at = data.find(b"\n")
            if at >= 0:
                return begin + (at + 1) * self._byte
        return math.inf

    def deliver(self, now: float, *, draining: bool) -> None:
        """Let all bytes arrive that are due; `draining`: the controller reads them at once."""
        while self._coming:
            begin, data = self._coming[0]
            count = min(len(data), int((now - begin) / self._byte + 1e-6))
            if count <= 0:
                return
            arrived = data[:count]
            if begin < self.deaf_until:
                deaf = math.ceil((self.deaf_until - begin) / self._byte)
                self.lost += len(arrived[:deaf])
                arrived = arrived[deaf:]
            room = len(arrived) if draining else self.size - len(self._buffer)
            self._buffer += arrived[:room]
            self.lost += len(arrived[room:])
            if count < len(data):
                self._coming[0] = (begin + count * self._byte, data[count:])
                return
            self._coming.popleft()

    def read_line(self) -> bytes | None:
        """Take the next whole line from the buffer; None where its end is still to come."""
        at = self._buffer.find(b"\n")
        if at < 0:
            self._line += self._buffer
            self._buffer.clear()
            return None
        line = bytes(self._line + self._buffer[:at])
        self._line.clear()
        del self._buffer[: at + 1]
        return line

    def clear(self) -> None:
        """Forget what was received, as a reset does; what is on the wire still comes."""
        self._buffer.clear()
        self._line.clear()

    @property
    def free(self) -> int:
        """Bytes free in the receive buffer."""
        return self.size - len(self._buffer)

    @property
    def empty(self) -> bool:
        """True where nothing waits in the receive buffer."""
        return not self._buffer

    def say(self, text: str, now: float) -> None:
        """Put a line of the controller's on the wire out."""
        data = text.encode("ascii") + b"\r\n"
        self._said = max(now, self._said) + len(data) * self._byte
        self.sent.append((self._said, data))
