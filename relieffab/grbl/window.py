"""Character counting: what is on its way to Grbl's receive buffer and not yet acknowledged."""

from collections import deque


class Window:
    """Lines sent and not yet acknowledged, never more bytes than the buffer holds.

    Parameters
    ----------
    capacity : int
        Bytes the controller takes before it has read any.
    """

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.bytes = 0
        self._pending: deque[tuple[int, int]] = deque()

    def __len__(self) -> int:
        return len(self._pending)

    def fits(self, size: int) -> bool:
        """Say whether a line of `size` bytes, its line end counted, may go now."""
        return self.bytes + size <= self.capacity

    def sent(self, index: int, size: int) -> None:
        """Count line `index` in."""
        self._pending.append((index, size))
        self.bytes += size

    def acknowledged(self) -> int | None:
        """Count the oldest line out; return its index, or None where none is pending."""
        if not self._pending:
            return None
        index, size = self._pending.popleft()
        self.bytes -= size
        return index
