"""index.html: all jobs of a batch on one page, to look through, search and sort."""

from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

from relieffab.catalogue.rows import DONE, FAILED, KEPT, WAITING
from relieffab.html import renderer
from relieffab.job.sheet.words import clock


def verdict(row: Mapping[str, Any]) -> str:
    """Say in a few words what came of a job that did not fail."""
    if row["findings"]:
        return "has findings"
    if row["carves"] is None:
        return {"layers": "layers only", "relief": "relief only"}.get(row["stage"], row["stage"])
    return "carves the relief" if row["carves"] else "does not carve the relief"


def _sides(size: tuple[float, float]) -> str:
    return " × ".join(f"{side:g}" for side in size)  # noqa: RUF001


def _file(path: str) -> str:
    return PurePath(path).name


_render = renderer(
    "relieffab.catalogue",
    "page",
    "index.html",
    clock=clock,
    verdict=verdict,
    sides=_sides,
    file=_file,
)


def index(batch: Mapping[str, Any]) -> str:
    """Lay a batch out as HTML.

    Parameters
    ----------
    batch : mapping
        What batch.json holds.

    Returns
    -------
    str
        A page that takes nothing but thumbnails from beside it.
    """
    rows = batch["jobs"]
    made = [row for row in rows if row["status"] in (DONE, KEPT)]
    return _render(
        batch=batch,
        made=made,
        failed=[row for row in rows if row["status"] == FAILED],
        waiting=[row for row in rows if row["status"] == WAITING],
        cutting=sum(row["cutting_s"] or 0 for row in made),
    )
