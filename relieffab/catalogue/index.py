"""index.html: all jobs of a batch on one page, to look through, search and sort."""

from collections.abc import Mapping
from functools import cache
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from relieffab.catalogue.rows import DONE, FAILED, KEPT, WAITING
from relieffab.job.sheet.words import clock

if TYPE_CHECKING:
    from jinja2 import Template


@cache
def _template() -> "Template":
    from jinja2 import Environment, PackageLoader, StrictUndefined

    there = Environment(
        loader=PackageLoader("relieffab.catalogue", "page"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    there.filters.update(clock=clock, verdict=verdict, sides=_sides, file=_file)
    return there.get_template("index.html")


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
    return _template().render(
        batch=batch,
        made=made,
        failed=[row for row in rows if row["status"] == FAILED],
        waiting=[row for row in rows if row["status"] == WAITING],
        cutting=sum(row["cutting_s"] or 0 for row in made),
    )
