"""Character counting: what is on its way to Grbl's receive buffer and not yet acknowledged."""

from collections import deque

from relieffab.grbl.program import Line


class Window:
    """Lines sent and not yet acknowledged, never more bytes than the buffer holds.

    Parameters
    ----------
    capacity : int
        Bytes the controller takes before it has read any.

    Attributes
    ----------
    bytes : int
        Of the lines pending.
    total : int
        Bytes ever sent.
    """

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.bytes = self.total = 0
        self._pending: deque[Line] = deque()

    def __len__(self) -> int:
        return len(self._pending)

    @property
    def first(self) -> Line | None:
        """The oldest line pending."""
        return self._pending[0] if self._pending else None

    def fits(self, size: int) -> bool:
        """Say whether a line of `size` bytes, its line end counted, may go now."""
        return self.bytes + size <= self.capacity

    def sent(self, line: Line) -> None:
        """Count a line in."""
        self._pending.append(line)
        self.bytes += len(line.wire)
        self.total += len(line.wire)

    def acknowledged(self) -> Line | None:
        """Count the oldest line out and return it; None where none is pending."""
        if not self._pending:
            return None
        line = self._pending.popleft()
        self.bytes -= len(line.wire)
        return line

    def excess(self, used: int, *, waiting: bool = False) -> int:
        """Bytes in the controller's buffer that we did not send, or had acknowledged.

        Parameters
        ----------
        used : int
            Bytes in its buffer, by its own report.
        waiting : bool
            It waits for room in its planner, the oldest line wholly read.
        """
        first = len(self._pending[0].wire) if waiting and self._pending else 0
        return used - (self.bytes - first)

    def missing(self, sent: int, used: int) -> int:
        """Bytes that must lie in the controller's buffer and do not.

        Grbl reads one line at a time and acknowledges it before it reads the next, so all that
        had been sent when it was asked, and is not acknowledged, is in its buffer, except for
        the oldest line.

        Parameters
        ----------
        sent : int
            `total` when the controller was asked.
        used : int
            Bytes in its buffer, by its own report.
        """
        owed = self.bytes - (self.total - sent)
        return owed - used - len(self._pending[0].wire) if self._pending else 0
