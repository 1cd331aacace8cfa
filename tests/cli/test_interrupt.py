import signal

import pytest

from relieffab.cli import interrupt
from relieffab.progress import silent


@pytest.fixture
def listening(monkeypatch):
    monkeypatch.setattr(interrupt, "_asked", False)
    # Whatever started the tests may have them ignored.
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = {number: signal.signal(number, signal.SIG_DFL) for number in numbers}
    interrupt.listen()
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_stop_that_went_unheard_is_heard_at_the_next_step(listening, number):
    told = []
    progress = interrupt.heeding(lambda *step: told.append(step))
    progress("relief", 0, 1)
    with pytest.raises(KeyboardInterrupt):  # as a callback of C code would swallow it
        signal.raise_signal(number)
    with pytest.raises(KeyboardInterrupt):
        progress("relief", 1, 1)
    assert told == [("relief", 0, 1, "")]


def test_without_a_stop_nothing_is_raised(listening):
    interrupt.heeding(silent)("relief", 0, 1)


def test_nothing_is_raised_inside_the_compiler(listening):
    inside = {"__name__": "llvmlite.binding.executionengine", "signal": signal}
    exec("def callback():\n    signal.raise_signal(signal.SIGTERM)", inside)
    inside["callback"]()
    with pytest.raises(KeyboardInterrupt):
        interrupt.heeding(silent)("relief", 1, 1)
