"""The lines of a program as they are fed to the machine, each with the way it goes."""

from relieffab.grbl import lines
from relieffab.grbl.program import Line, Program
from relieffab.grbl.tracker import Tracker
from relieffab.grbl.way import Motion, Place


class Feed:
    """One line after the other, followed from where the machine stands.

    Parameters
    ----------
    program : Program
    position : tuple
        Work coordinates before the first line sent, mm.
    first : int
        Index of the first line to send; those before it are only followed.

    Attributes
    ----------
    next : Line or None
        What `take` will give; None at the end.
    total : int
        Lines of the program.
    cut_mm : float
        Length of cut before the first line, mm.
    """

    def __init__(self, program: Program, position: Place, first: int = 0) -> None:
        self.total = len(program)
        self.cut_mm = 0.0
        self._source = program.read()
        self.tracker = Tracker(position)
        self.next: Line | None = next(self._source, None)
        while self.next is not None and self.next.index < first:
            _, motion = self.take()
            if motion is not None and motion.cutting:
                self.cut_mm += motion.length
        self.tracker.position = position

    def start_at(self, position: Place) -> None:
        """Go on from where the machine has come to meanwhile."""
        self.tracker.position = position

    def take(self) -> tuple[Line, Motion | None]:
        """Give the next line and the way it goes; there must be one."""
        line = self.next
        if line is None:
            raise IndexError("the program is at its end")
        motion = self.tracker.follow(line.text)
        self.next = next(self._source, None)
        return line, motion

    @property
    def followed(self) -> bool:
        """False once work zero was moved."""
        return self.tracker.followed


def alone(line: Line) -> bool:
    """Say whether nothing else may be on its way while Grbl works on this line."""
    return lines.stores(line.text)
