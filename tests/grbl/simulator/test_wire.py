import pytest

from relieffab.grbl.simulator.wire import Wire

BYTE = 1e-3


@pytest.fixture
def wire():
    return Wire(10 / BYTE, 8)


def test_bytes_take_their_time(wire):
    wire.push(b"G0\n", 1.0)
    assert wire.newline_at() == pytest.approx(1.0 + 3 * BYTE)
    wire.deliver(1.0 + 2 * BYTE, draining=False)
    assert wire.free == 6
    assert wire.read_line() is None
    wire.deliver(1.0 + 3 * BYTE, draining=False)
    assert wire.read_line() == b"G0"


def test_what_does_not_fit_is_lost(wire):
    wire.push(b"0123456789\n", 0.0)
    wire.deliver(1.0, draining=False)
    assert (wire.lost, wire.free) == (3, 0)


def test_a_buffer_that_is_read_meanwhile_loses_nothing(wire):
    wire.push(b"0123456789\n", 0.0)
    wire.deliver(1.0, draining=True)
    assert wire.lost == 0
    assert wire.read_line() == b"0123456789"


def test_real_time_bytes_are_picked_out_at_their_own_time(wire):
    wire.push(b"G0(!\xc4)\n?", 0.0)
    assert [byte for _, byte in wire.urgent] == [ord("!"), 0xC4, ord("?")]
    assert wire.urgent[0][0] == pytest.approx(4 * BYTE)
    wire.deliver(1.0, draining=False)
    assert wire.read_line() == b"G0()"


def test_carriage_return_ends_a_line_of_its_own(wire):
    wire.push(b"M5\r\n", 0.0)
    wire.deliver(1.0, draining=False)
    assert [wire.read_line(), wire.read_line(), wire.read_line()] == [b"M5", b"", None]


def test_a_deaf_controller_loses_bytes(wire):
    wire.deaf_until = 0.0035
    wire.push(b"abcdef\n", 0.0)
    wire.deliver(1.0, draining=False)
    assert (wire.lost, wire.read_line()) == (4, b"ef")
