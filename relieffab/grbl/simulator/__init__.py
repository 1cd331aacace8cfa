"""A simulated Grbl 1.1h, written from Grbl's documented and measured behaviour.

    wire.py         bytes on their way in and out, the receive buffer that overflows
    interpreter.py  a line of G-code -> actions, or the error Grbl gives
    words.py        letters and numbers, modal groups
    arcs.py         G2 and G3 as chords
    planner.py      look-ahead over 15 moves; profile.py: one move's speed over time
    settings.py     the $ settings; commands.py: the $ commands
    realtime.py     bytes that act at once; suspend.py: holds and the safety door
    probing.py      G38 towards a touch plate
    reports.py      what is printed: status, settings, offsets
    processor.py    one line after the other, each as long as it takes
    machine.py      the virtual clock that ties them together
    faults.py       noise on the line, and what else goes wrong, on demand

It knows nothing of the sender and shares no code with it.  Not simulated: laser mode, and
homing that fails.
"""

from relieffab.grbl.simulator.machine import SimulatedGrbl

__all__ = ["SimulatedGrbl"]
