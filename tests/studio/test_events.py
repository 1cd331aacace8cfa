import asyncio
import json
import threading

from anyio.from_thread import start_blocking_portal

from relieffab.studio import events as module
from relieffab.studio.events import Events


async def _take(stream, count):
    return [await asyncio.wait_for(anext(stream), 5) for _ in range(count)]


def carry_out(main):
    """Run in a loop of its own thread: a browser's driver may hold the one of this."""
    with start_blocking_portal() as portal:
        return portal.call(main)


def facts(lines):
    return [json.loads(line.removeprefix("data: ")) for line in lines]


def test_the_present_comes_first_and_news_from_any_thread_after():
    async def main():
        events = Events()
        one, other = events.listen({"now": 0}), events.listen({"now": 0})
        first = await _take(one, 1) + await _take(other, 1)
        thread = threading.Thread(target=lambda: [events.publish({"n": n}) for n in range(3)])
        thread.start()
        found = [await _take(stream, 3) for stream in (one, other)]
        thread.join()
        return first, found

    first, found = carry_out(main)
    assert facts(first) == [{"now": 0}, {"now": 0}]
    assert [facts(lines) for lines in found] == [[{"n": 0}, {"n": 1}, {"n": 2}]] * 2
    assert all(line.endswith("\n\n") for lines in found for line in lines)


def test_with_nobody_listening_news_are_dropped():
    Events().publish({"n": 1})


def test_silence_is_broken_by_a_word_that_means_nothing(monkeypatch):
    monkeypatch.setattr(module, "ALIVE", 0.01)

    async def main():
        return await _take(Events().listen({}), 2)

    assert carry_out(main)[1] == ":\n\n"


def test_closing_ends_the_stream_and_forgets_it():
    async def main():
        events = Events()
        stream = events.listen({})
        await _take(stream, 1)
        threading.Thread(target=events.close).start()
        rest = [line async for line in stream]
        return rest, events

    rest, events = carry_out(main)
    assert rest == []
    assert not events._queues
