"""A simulated machine to talk to."""

import pytest

from relieffab.grbl.simulator import SimulatedGrbl


class Bench:
    """A machine with everything it said so far."""

    def __init__(self, **options):
        self.machine = SimulatedGrbl(**{"boot": 0.1} | options)
        self.said = []
        self.wait(0.2)

    def wait(self, seconds):
        self.machine.run(self.machine.now + seconds)
        self.said += [data.decode().strip() for _, data in self.machine.wire.sent]
        self.machine.wire.sent.clear()
        return self

    def tell(self, data, seconds=0.2):
        self.said.clear()
        self.machine.write(data if isinstance(data, bytes) else data.encode() + b"\n")
        return self.wait(seconds).said

    def state(self):
        return self.tell(b"?")[0][1:].partition("|")[0]


@pytest.fixture
def new_bench():
    return Bench


@pytest.fixture
def bench():
    return Bench()
