"""What a relief keeps of its model, against the width of its forms and against its depth.

    python tests/benchmarks/likeness.py form  [MODEL ...] [--view right]
    python tests/benchmarks/likeness.py depth [MODEL ...] [--view right]

`form` makes reliefs whose forms follow the depth order from another width each: the
lengths are a share of the figure, as the default is.  `depth` makes them deeper and
deeper, to see what more depth gives and what it takes.  Walls are free, since drafted
ones would make all reliefs alike where they stand.
"""

import sys
from argparse import ArgumentParser
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from lines import RESOLUTION, SIZE, models

from relieffab import Carving, Layers, make_layers, make_relief, named_view
from relieffab.errors import InputError
from relieffab.job.compare import FREE
from relieffab.layers.view import VIEWS
from relieffab.relief.quality.detail import SCALES, detail
from relieffab.relief.quality.order import order
from relieffab.relief.quality.pair import Pair
from relieffab.relief.quality.relit import relit
from relieffab.relief.quality.visibility import visibility
from relieffab.relief.window import figure_size

Row = tuple[float, ...]

LENGTHS = (1.0, 1.4, 2.0, 2.8, 4.0, 6.0)  # percent of the figure's width or height
DEPTHS = (2.0, 5.0, 10.0, 15.0, 20.0)  # percent of the figure's height
USUAL = 5.0
CELL = 10


def relief_of(layers: Layers, percent: float, form: float | None = None) -> Pair:
    """Carve as deep as a share of the figure's height, beside what it was made from."""
    height, width = figure_size(layers)
    length = None if form is None else form / 100 * max(height, width)
    carving = Carving(depth=percent / 100 * height, form_length=length, wall_angle=FREE)
    return Pair(make_relief(layers, carving)[0], layers)


def likeness(pair: Pair) -> Row:
    """Likeness, order and lines: what form lengths are weighed by."""
    kept = order(pair)
    return relit(pair).oblique_ncc, kept.local, kept.overall, visibility(pair).median


def richness(pair: Pair) -> Row:
    """Likeness, contrast, detail by band and order: what depth is weighed by."""
    lit, bands, kept = relit(pair), detail(pair), order(pair)
    fine = (getattr(bands, f"s{scale}") for scale in SCALES)
    return lit.oblique_ncc, lit.inside_contrast, *fine, kept.local, kept.overall


def print_row(first: str, cells: Sequence[object], after: str = "") -> None:
    """Print a name or a number and what belongs to it."""
    texts = (f"{cell:.3f}" if isinstance(cell, float) else str(cell) for cell in cells)
    print(f"{first:>16}" + "".join(f"{text:>{CELL}}" for text in texts) + after, flush=True)


def form(layers: Layers) -> None:
    """Print what each form length gives, and mark the one that is taken if none is given.

    The mark goes by the figures, and to the nearest of them: where no length is given,
    every coarser grid takes that of its own figure, which a pixel's side may change.
    """
    print_row("form length, %", ("NCC", "local", "overall", "lines"))
    usual = likeness(relief_of(layers, USUAL))
    rows = {length: likeness(relief_of(layers, USUAL, length)) for length in LENGTHS}
    away = {length: np.nansum(np.subtract(row, usual) ** 2) for length, row in rows.items()}
    default = min(away, key=away.__getitem__)
    for length, row in rows.items():
        print_row(f"{length:g}", row, "  <- default" if length == default else "")


def depth(layers: Layers) -> None:
    """Print what each depth gives: contrast and bands on the same pixels for all.

    Walls widen with the depth, and pixels beside them are not compared; were each
    relief measured away from its own walls, deeper ones would be on other pixels.
    """
    pairs = {percent: relief_of(layers, percent) for percent in DEPTHS}
    deepest = max(pair.relief.depth for pair in pairs.values())
    alike = {p: Pair(replace(pair.relief, depth=deepest), layers) for p, pair in pairs.items()}
    first = alike[DEPTHS[0]]
    share = (first.from_edge > first.strip).sum() / layers.mask.sum()
    print(f"  contrast and bands away from the widest walls, on {100 * share:.0f} % of the figure")
    print_row("depth, %", ("NCC", "contrast", *(f"s{s}" for s in SCALES), "local", "overall"))
    for percent, pair in alike.items():
        print_row(f"{percent:g}", richness(pair))


def seen(paths: list[str], view: str) -> Iterator[tuple[str, Layers]]:
    """Every model from that view, on the usual panel."""
    for mesh, up in models(paths):
        layers = make_layers(mesh, named_view(view, up), size=SIZE, resolution=RESOLUTION)
        yield mesh.name, layers


def main() -> None:
    """Print a table of every model."""
    tables = {"form": form, "depth": depth}
    parser = ArgumentParser(description="What a relief keeps of its model.")
    parser.add_argument("table", choices=tables)
    parser.add_argument("models", nargs="*", metavar="MODEL", help="two built-in ones if none")
    parser.add_argument("--view", choices=VIEWS, default="front")
    asked = parser.parse_args()
    try:
        for name, layers in seen(asked.models, asked.view):
            height, width = figure_size(layers)
            print(
                f"{name}, {asked.view}: {width:.0f} x {height:.0f} mm "
                f"on a panel of {SIZE[0]:g} x {SIZE[1]:g} at {RESOLUTION[0]} x {RESOLUTION[1]}"
            )
            tables[asked.table](layers)
    except InputError as fault:
        sys.exit(str(fault))


if __name__ == "__main__":
    main()
