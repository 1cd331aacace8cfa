"""How well senders keep a Grbl fed: ours, send-response, and one published in Python.

    pip install grbl-streamer        # the peer, GPL-3; left out where it is not installed
    python tests/benchmarks/streaming.py [LINES]

A machine at the far end of a pseudo terminal takes 0.1 mm segments, up to 500 lines a second,
as an 8-bit Grbl does: 128 bytes of receive buffer, bytes that take their time at 115200 baud,
an answer delayed by the USB adapter (1 ms and 16 ms).  Each sender is a process of its own and
tells the processor time it took from the first line to the last.  `buffer` is what the machine
has before it each time it takes a line: bytes received, and bytes still on the wire to it.
"""

import os
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
import tty
from collections import deque
from pathlib import Path

BUFFER, RATE, BYTE = 128, 500.0, 10 / 115200
ANSWERS = {
    b"$I": "[VER:1.1h.20190825:]\r\n[OPT:V,15,128]\r\n",
    b"$#": "[G54:0.000,0.000,0.000]\r\n[PRB:0.000,0.000,0.000:0]\r\n",
    b"$G": "[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\n",
    b"$$": "".join(f"${n}=100.000\r\n" for n in (*range(8), 11, 13, 22, 23, 24, 25, 26, 27, 30, 31,
                                                  *range(100, 103), *range(110, 113),
                                                  *range(120, 123), *range(130, 133)))
           .replace("$13=100.000", "$13=0").replace("$22=100.000", "$22=0")
           .replace("$23=100.000", "$23=0"),
}  # fmt: skip
BANNER = "\r\nGrbl 1.1h ['$' for help]\r\n"


class Machine:
    """The far end of a pseudo terminal."""

    def __init__(self, latency: float) -> None:
        self.master, slave = pty.openpty()
        tty.setraw(slave)
        self.slave, self.name, self.latency = slave, os.ttyname(slave), latency
        self.wire: deque = deque()
        self.out: deque = deque()
        self.buffer = bytearray()
        self.arrives = self.ready = 0.0
        self.lines, self.fill, self.lost, self.bounds = 0, 0.0, 0, [0.0, 0.0]
        self.place = {"X": 0.0, "Y": 0.0, "Z": 0.0}
        self.busy_until = 0.0

    def run(self, process: subprocess.Popen) -> None:
        """Serve until the sender is done."""
        os.set_blocking(self.master, False)
        self.say(BANNER, time.perf_counter() + 0.3)
        while process.poll() is None:
            if select.select([self.master], [], [], 0.0004)[0]:
                self.receive(os.read(self.master, 4096))
            now = time.perf_counter()
            self.arrive(now)
            self.work(now)
            while self.out and self.out[0][0] <= now:
                os.write(self.master, self.out.popleft()[1])

    def say(self, text: str, now: float) -> None:
        self.out.append((now + self.latency, text.encode()))

    def receive(self, data: bytes) -> None:
        for byte in data:
            self.arrives = max(self.arrives, time.perf_counter()) + BYTE
            self.wire.append((self.arrives, byte))

    def arrive(self, now: float) -> None:
        while self.wire and self.wire[0][0] <= now:
            byte = self.wire.popleft()[1]
            if byte == ord("?"):
                self.report(now)
            elif byte == 0x18:
                self.buffer.clear()
                self.say(BANNER, now)
            elif byte in b"!~" or byte >= 0x80:
                continue
            elif len(self.buffer) < BUFFER:
                self.buffer.append(byte)
            else:
                self.lost += 1

    def work(self, now: float) -> None:
        while now >= self.ready and (end := self.buffer.find(b"\n")) >= 0:
            line = bytes(self.buffer[:end])
            if line.startswith((b"G1", b"G01")):  # the peer writes G01
                self.count(now)
            del self.buffer[: end + 1]
            if line.startswith(b"$"):
                self.say(ANSWERS.get(line, ""), now)
            for axis, value in re.findall(r"([XYZ])(-?[\d.]+)", line.decode()):
                self.place[axis] = float(value)
            self.ready = max(self.ready + 1 / RATE, now - 1 / RATE)
            if not line.startswith(b"$"):
                self.busy_until = now + 0.05
            self.say("ok\r\n", now)

    def count(self, now: float) -> None:
        self.bounds = [self.bounds[0] if self.lines else now, now]
        self.lines += 1
        self.fill += min(len(self.buffer) + len(self.wire), BUFFER) / BUFFER

    def report(self, now: float) -> None:
        state = "Run" if now < self.busy_until else "Idle"
        place = ",".join(f"{self.place[axis]:.3f}" for axis in "XYZ")
        free = BUFFER - len(self.buffer)
        self.say(f"<{state}|MPos:{place}|Bf:15,{free}|FS:0,0>\r\n", now)


def ours(name: str, text: str) -> float:
    """Send with relieffab."""
    from relieffab.grbl.job import Job
    from relieffab.grbl.port import open_port
    from relieffab.grbl.program import prepare
    from relieffab.grbl.sender import Company, send

    begin: list[float] = []
    with open_port(name) as port:
        job = Job(prepare(text))
        send(job, port, Company(confirm=lambda _: begin.append(time.process_time()) or True))
    return time.process_time() - begin[0]


def send_response(name: str, text: str) -> float:
    """Send a line, wait for its ok."""
    import serial

    with serial.Serial(name, 115200, timeout=5) as port:
        while b"Grbl" not in port.readline():
            pass
        begin = time.process_time()
        for line in text.splitlines():
            port.write(line.encode() + b"\n")
            while port.readline() != b"ok\r\n":
                pass
        return time.process_time() - begin


def peer(name: str, text: str) -> float:
    """Send with grbl-streamer, in its character-counting mode."""
    import threading

    from grbl_streamer import GrblStreamer

    done, booted = threading.Event(), threading.Event()

    def hear(event: str, *_: object) -> None:
        if event == "on_job_completed":
            done.set()
        elif event == "on_settings_downloaded" or event == "on_boot":
            booted.set()

    sender = GrblStreamer(hear)
    sender.cnect(name, 115200)
    booted.wait(5)
    time.sleep(1)
    sender.incremental_streaming = False
    sender.poll_start()
    time.sleep(1)  # its own questions must be answered before the job
    with tempfile.NamedTemporaryFile("w", suffix=".nc") as file:
        file.write(text)
        file.flush()
        sender.load_file(file.name)
    done.clear()
    begin = time.process_time()
    sender.job_run()
    done.wait(300)
    spent = time.process_time() - begin
    sender.disconnect()
    return spent


SENDERS = {"relieffab": ours, "send-response": send_response, "grbl-streamer": peer}


def program(count: int) -> str:
    """Write 0.1 mm segments up and down a relief, about 20 bytes a line."""
    lines = [
        f"G1X{i % 500 * 0.1:.1f}Y{i // 500 * 0.1:.1f}Z-{i * 7 % 90 * 0.01:.2f}"
        for i in range(count)
    ]
    return "\n".join(["F3000", *lines, "M5"])


def measure(sender: str, latency: float, count: int) -> dict[str, float]:
    """Let one sender send, and look at what the machine had."""
    machine = Machine(latency)
    command = [sys.executable, __file__, "--send", sender, machine.name, str(count)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    machine.run(process)
    out, err = process.communicate()
    os.close(machine.master)
    os.close(machine.slave)
    if process.returncode or machine.lines != count or machine.lost:
        raise SystemExit(
            f"{sender}: {machine.lines} lines, {machine.lost} bytes lost\n{err[-900:]}"
        )
    seconds = machine.bounds[1] - machine.bounds[0]
    return {
        "rate": (count - 1) / seconds,
        "buffer": machine.fill / count,
        "processor": float(out.split()[-1]) / seconds,
    }


def main() -> None:
    """Measure all senders in one run and print ratios."""
    if sys.argv[1:2] == ["--send"]:
        print(SENDERS[sys.argv[2]](sys.argv[3], program(int(sys.argv[4]))))
        return
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 5000
    try:
        import grbl_streamer as _  # noqa: F401

        senders = list(SENDERS)
    except ImportError:
        senders = ["relieffab", "send-response"]
        print("grbl-streamer is not installed and left out")
    print(
        f"{count:,} lines of 0.1 mm, {len(program(count)) / count:.1f} bytes each, 500 lines/s most"
    )
    for latency in (0.001, 0.016):
        found = {name: measure(name, latency, count) for name in senders}
        print(
            f"\nUSB latency {latency * 1000:.0f} ms    lines/s   buffer   processor   ours/theirs"
        )
        for name, row in found.items():
            print(
                f"  {name:<18} {row['rate']:7.0f}   {row['buffer']:5.0%}   {row['processor']:8.1%}"
                f"   {found['relieffab']['rate'] / row['rate']:8.2f}"
            )


if __name__ == "__main__":
    assert Path(__file__).is_file()
    main()
