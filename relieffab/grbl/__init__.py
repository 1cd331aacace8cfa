"""Text to a machine: Grbl over serial.

program.py     lines cleaned, checked and measured (travel.py) before a byte is sent
protocol.py    one job as a pure state machine: bytes and the time in, bytes out
stage.py       what its stages share: greeting.py, streaming.py (window.py), stop.py
messages.py    what Grbl says, read; codes.py: what its numbers mean
controller.py  what a controller says of itself, and whether a program fits it
port.py        serial ports, the only home of pyserial
sender.py      glue: `send(program, port)` -> SendReport
simulator/     a Grbl 1.1h to try it all on, as sim:// through handlers/
"""
