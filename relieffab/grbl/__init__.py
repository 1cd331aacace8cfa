"""Text to a machine: Grbl over serial.

lines.py       one line: cleaned, checked; tracker.py, modal.py, way.py: where a program goes
program.py     a whole program, checked and measured (before.py: programs of our own)
protocol.py    one job as a pure state machine: bytes and the time in, bytes out
               stages: greeting.py, streaming.py, stop.py; stage.py is what they share
job.py         what is wanted, and the plan once the machine was asked (controller.py, review.py)
streaming.py   feed.py gives lines, window.py counts bytes, course.py finds the machine on the
               program, watch.py judges its reports, pace.py foretells the time
resume.py      taking a job up again (record.py); joblog.py: every byte, to be replayed
messages.py    what Grbl says, read; codes.py: what its numbers mean; realtime.py: its keys
port.py        serial ports, the only home of pyserial
sender.py      `send(job, port, company)` -> SendReport; drive.py carries the bytes,
               company.py is who takes part, view.py what a person sees
profile.py     a machine's profile from its settings
simulator/     a Grbl 1.1h to try it all on, as sim:// through handlers/
"""
