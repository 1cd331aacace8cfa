"""What a report tells of a chisel's marks."""

from collections.abc import Mapping
from typing import Any


def styles_in(report: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Gather what a report tells of marks: its own, or those of the reliefs composed in it."""
    if "style" in report:
        return [report["style"]]
    return [style for part in report.get("reliefs", []) for style in part.get("styles", [])]
