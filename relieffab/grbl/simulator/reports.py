"""What the simulated Grbl prints, word for word as version 1.1h does."""

from collections.abc import Sequence
from dataclasses import dataclass

from relieffab.grbl.simulator.interpreter import Interpreter
from relieffab.grbl.simulator.wire import Wire

HELP = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]"
BANNER = "Grbl 1.1h ['$' for help]"
HAL_BANNER = "GrblHAL 1.1f ['$' or '$HELP' for help]"
LOCKED = "[MSG:'$H'|'$X' to unlock]"


def point(values: Sequence[float], *, inches: bool = False) -> str:
    """Coordinates, mm or inches ($13); A in degrees."""
    return ",".join(
        f"{value / 25.4:.4f}" if inches and axis < len("XYZ") else f"{value:.3f}"
        for axis, value in enumerate(values)
    )


def build_info(wire: Wire, blocks: int, axes: int = 3) -> list[str]:
    """`$I`."""
    if axes > len("XYZ"):
        names = [f"[AXS:{axes}:XYZA]", "[NEWOPT:RT+]", "[FIRMWARE:grblHAL]"]
        return ["[VER:1.1f.20240330:]", f"[OPT:V,{blocks},{wire.size},{axes},0]", *names]
    return ["[VER:1.1h.20190825:]", f"[OPT:V,{blocks},{wire.size}]"]


def offsets(interpreter: Interpreter, probed: "Probed", *, inches: bool) -> list[str]:
    """`$#`."""
    systems = interpreter.coordinates.systems
    tool = [interpreter.coordinates.tool_length]
    if turning := interpreter.coordinates.letters[3:]:
        tool = [0.0, 0.0, *tool, *[0.0] * len(turning)]
    return [
        *(f"[G{number:g}:{point(zero, inches=inches)}]" for number, zero in systems.items()),
        f"[G92:{point(interpreter.coordinates.g92, inches=inches)}]",
        f"[TLO:{point(tool, inches=inches)}]",
        probed.line(inches=inches),
    ]


@dataclass(frozen=True)
class Probed:
    """Where the probe touched last, machine mm, and whether it did."""

    place: tuple[float, ...] = (0.0, 0.0, 0.0)
    touched: bool = False

    def line(self, *, inches: bool) -> str:
        """As printed after a probing move and by `$#`."""
        return f"[PRB:{point(self.place, inches=inches)}:{int(self.touched)}]"


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
        accessories: str,
        mask: int,
        inches: bool,
    ) -> str:
        """One report; `room` is blocks and bytes free, `pace` mm/min and rpm."""
        if mask & 1:
            where = f"MPos:{point(position, inches=inches)}"
        else:
            work = [p - o for p, o in zip(position, offset, strict=True)]
            where = f"WPos:{point(work, inches=inches)}"
        fields = [state, where]
        if mask & 2:
            fields.append(f"Bf:{room[0]},{room[1]}")
        feed = pace[0] / 25.4 if inches else pace[0]
        fields.append(f"FS:{feed:.0f},{pace[1]:.0f}")
        busy = state.partition(":")[0] in ("Run", "Hold", "Home", "Door")
        if self._until_offset <= 0:
            fields.append(f"WCO:{point(offset, inches=inches)}")
            self._until_offset = 30 if busy else 10
            self._until_overrides = max(self._until_overrides, 1)
        elif self._until_overrides <= 0:
            fields.append("Ov:" + ",".join(str(value) for value in overrides))
            if accessories:
                fields.append(f"A:{accessories}")
            self._until_overrides = 20 if busy else 10
        self._until_offset -= 1
        self._until_overrides -= 1
        return "<" + "|".join(fields) + ">"

    def offset_changed(self) -> None:
        """Have the next report name the offset."""
        self._until_offset = 0
