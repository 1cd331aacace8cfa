"""Shown: what there is to see of a file, and what is to be said of it."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.stock import Stock


@dataclass(frozen=True, eq=False)
class Shown:
    """A picture or a page, and facts.

    Parameters
    ----------
    kind : str
        'relief', 'solid', 'program', 'picture', 'page' or 'job'.
    facts : dict
        For people and programs alike; lengths in mm, times in seconds.
    image : (rows, cols, 3) or (rows, cols) ndarray of uint8 or None
        None where there is only a page.
    page : Path or None
        A file a browser shows.
    notes : tuple of str
        What a person should know.
    """

    kind: str
    facts: dict[str, Any]
    image: NDArray[np.uint8] | None = None
    page: Path | None = None
    notes: tuple[str, ...] = field(default=())


def stock_facts(stock: Stock) -> dict[str, Any]:
    """Say how large a stock is; of a round one, its thickness and how long it is."""
    if stock.radius:
        return {"diameter_mm": 2 * stock.radius, "length_mm": stock.width}
    return {"stock_mm": [stock.width, stock.height, stock.thickness]}
