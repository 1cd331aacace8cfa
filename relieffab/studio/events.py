"""Events: what happens, told to every page that listens."""

import asyncio
import json
from collections.abc import AsyncIterator, Mapping
from typing import Any

ALIVE = 15.0
"""Seconds of silence after which a word is sent all the same."""


class Events:
    """Passes facts on from any thread to those who listen."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._queues: set[asyncio.Queue[str | None]] = set()
        self._closed = False

    def publish(self, fact: Mapping[str, Any]) -> None:
        """Tell a fact, from whichever thread."""
        self._pass_on(json.dumps(fact))

    def close(self) -> None:
        """End all listening, from whichever thread."""
        self._closed = True
        self._pass_on(None)

    def _pass_on(self, text: str | None) -> None:
        if self._loop and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._spread, text)

    def _spread(self, text: str | None) -> None:
        for queue in self._queues:
            queue.put_nowait(text)

    async def listen(self, first: Mapping[str, Any]) -> AsyncIterator[str]:
        """Give facts as server-sent events, the present one first."""
        self._loop = asyncio.get_running_loop()
        queue: asyncio.Queue[str | None] = asyncio.Queue()
        self._queues.add(queue)
        try:
            text: str | None = json.dumps(first)
            while text is not None and not self._closed:
                yield text if text.startswith(":") else f"data: {text}\n\n"
                try:
                    text = await asyncio.wait_for(queue.get(), ALIVE)
                except TimeoutError:
                    text = ":\n\n"
        finally:
            self._queues.discard(queue)
