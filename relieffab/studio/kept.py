"""Kept: the last result of each stage, worked out again only where it changes."""

from collections.abc import Callable
from typing import Any, TypeVar

Result = TypeVar("Result")


class Kept:
    """The last result of each stage, by what it depends on."""

    def __init__(self) -> None:
        self._held: dict[str, tuple[Any, Any]] = {}

    def once(self, stage: str, key: Any, make: Callable[[], Result]) -> Result:
        """Give what was made for this key, or make it."""
        held = self._held.get(stage)
        if held is None or held[0] != key:
            held = key, make()
            self._held[stage] = held
        return held[1]  # type: ignore[no-any-return]

    def last(self, stage: str) -> Any:
        """Give what a stage came to last, whatever for; None if it never did."""
        return self._held.get(stage, (None, None))[1]
