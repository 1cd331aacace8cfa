"""A simulated Grbl 1.1h, written from Grbl's documented and measured behaviour.

    wire.py         bytes on their way in and out, the receive buffer that overflows
    interpreter.py  a line of G-code -> actions, or the error Grbl gives
    words.py        letters and numbers, modal groups
    arcs.py         G2 and G3 as chords
    planner.py      look-ahead over 15 moves; profile.py: one move's speed over time
    settings.py     the $ settings
    reports.py      what is printed: status, settings, offsets
    commands.py     the $ commands
    machine.py      the virtual clock that ties them together

It knows nothing of the sender and shares no code with it.  Not simulated: jogging ($J=),
probing (G38), sleep, limit switches (beyond homing that always succeeds), laser mode.
"""

from relieffab.grbl.simulator.machine import SimulatedGrbl

__all__ = ["SimulatedGrbl"]
