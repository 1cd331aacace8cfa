"""What the simulated Grbl prints, word for word as version 1.1h does."""

from collections.abc import Sequence

from relieffab.grbl.simulator.interpreter import Interpreter
from relieffab.grbl.simulator.wire import Wire

HELP = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]"
BANNER = "Grbl 1.1h ['$' for help]"
LOCKED = "[MSG:'$H'|'$X' to unlock]"


def point(values: Sequence[float]) -> str:
    """Three coordinates, mm."""
    return ",".join(f"{value:.3f}" for value in values)


def build_info(wire: Wire, blocks: int) -> list[str]:
    """`$I`."""
    return ["[VER:1.1h.20190825:]", f"[OPT:V,{blocks},{wire.size}]"]


def offsets(interpreter: Interpreter) -> list[str]:
    """`$#`."""
    systems = interpreter.coordinates.systems
    return [
        *(f"[G{number:g}:{point(zero)}]" for number, zero in systems.items()),
        f"[G92:{point(interpreter.coordinates.g92)}]",
        f"[TLO:{interpreter.coordinates.tool_length:.3f}]",
        "[PRB:0.000,0.000,0.000:0]",
    ]


def modal(interpreter: Interpreter) -> str:
    """`$G`."""
    groups = [interpreter.modal[group] for group in (1, 12, 2, 6, 3, 5)]
    codes = " ".join(f"G{code:g}" for code in groups)
    tail = f"T{interpreter.tool} F{interpreter.feed:g} S{interpreter.speed:g}"
    return f"[GC:{codes} M{interpreter.spindle} M{interpreter.coolant} {tail}]"


class StatusReports:
    """`?`, with its extra fields on the reports on which Grbl adds them."""

    def __init__(self) -> None:
        self._until_offset = 0
        self._until_overrides = 1

    def line(
        self,
        state: str,
        position: Sequence[float],
        *,
        offset: Sequence[float],
        room: tuple[int, int],
        pace: tuple[float, float],
        overrides: tuple[int, int, int],
        mask: int,
    ) -> str:
        """One report; `room` is blocks and bytes free, `pace` mm/min and rpm."""
        if mask & 1:
            where = f"MPos:{point(position)}"
        else:
            work = [p - o for p, o in zip(position, offset, strict=True)]
            where = f"WPos:{point(work)}"
        fields = [state, where]
        if mask & 2:
            fields.append(f"Bf:{room[0]},{room[1]}")
        fields.append(f"FS:{pace[0]:.0f},{pace[1]:.0f}")
        busy = state.partition(":")[0] in ("Run", "Hold", "Home", "Door")
        if self._until_offset <= 0:
            fields.append(f"WCO:{point(offset)}")
            self._until_offset = 30 if busy else 10
            self._until_overrides = max(self._until_overrides, 1)
        elif self._until_overrides <= 0:
            fields.append("Ov:" + ",".join(str(value) for value in overrides))
            self._until_overrides = 20 if busy else 10
        self._until_offset -= 1
        self._until_overrides -= 1
        return "<" + "|".join(fields) + ">"

    def offset_changed(self) -> None:
        """Have the next report name the offset."""
        self._until_offset = 0
