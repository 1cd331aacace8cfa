"""The memory of `relieffab send` while programs of 10,000, 100,000 and 1,000,000 lines stream.

    python tests/benchmarks/million.py [LARGEST]

The machine at the far end of the pseudo terminal acknowledges at once: the wire is not modelled.
"""

import os
import re
import resource
import select
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import streaming


class Willing(streaming.Machine):
    """Takes every line the moment it arrives."""

    def run(self, process: subprocess.Popen) -> None:
        """Serve until the sender is done."""
        rest = b""
        os.write(self.master, streaming.BANNER.encode())
        while process.poll() is None:
            if select.select([self.master], [], [], 0.05)[0]:
                data = os.read(self.master, 65536)
                asked = data.count(b"?")
                *lines, rest = (rest + re.sub(rb"[?!~\x80-\xff]", b"", data)).split(b"\n")
                os.write(self.master, b"".join(self.answer(line) for line in lines))
                if asked:
                    os.write(self.master, self.status())

    def answer(self, line: bytes) -> bytes:
        if line.startswith(b"$"):
            return streaming.ANSWERS.get(line, "").encode() + b"ok\r\n"
        self.lines += 1
        self.last = line
        return b"ok\r\n"

    def status(self) -> bytes:
        for axis, value in re.findall(r"([XYZ])(-?[\d.]+)", self.last.decode()):
            self.place[axis] = float(value)
        place = ",".join(f"{self.place[axis]:.3f}" for axis in "XYZ")
        return f"<Idle|MPos:{place}|Bf:15,128|FS:0,0>\r\n".encode()

    last = b""


def measure(count: int, folder: Path) -> tuple[float, float]:
    """MiB at most, and seconds."""
    path = folder / f"{count}.nc"
    with path.open("w") as file:
        file.write("G0X0Y0Z5\nF3000\n")
        for i in range(count):
            z = i * 7 % 90 * 0.01
            file.write(f"G1X{i % 900 * 0.1:.1f}Y{i // 900 * 0.1:.1f}Z-{z:.2f}\n")
    machine = Willing(0.0)
    command = [sys.executable, "-m", "relieffab", "send", str(path), "--port", machine.name]
    environment = os.environ | {"XDG_STATE_HOME": str(folder)}
    begin = time.perf_counter()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, env=environment) as process:
        machine.run(process)
    if process.returncode or machine.lines != count + 2:
        raise SystemExit(f"{machine.lines} lines came, exit status {process.returncode}")
    most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return most, time.perf_counter() - begin


def main() -> None:
    """Print one row a size; the largest comes last, since the system tells only the maximum."""
    largest = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    print("    lines   MiB at most   seconds")
    with tempfile.TemporaryDirectory() as folder:
        for count in (largest // 100, largest // 10, largest):
            most, seconds = measure(count, Path(folder))
            print(f"{count:9,}   {most:11.1f}   {seconds:7.1f}")


if __name__ == "__main__":
    main()
