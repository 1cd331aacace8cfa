"""compare: one model by every method, side by side."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from relieffab.cli import console
from relieffab.cli.options import CompareFlags, Json, Overwrite, Source, model_settings

# Two lines of heading, and where in a relief's quality the figure is.
COLUMNS = (
    ("NCC", "front", "relit", "frontal_ncc"),
    ("NCC", "obliq", "relit", "oblique_ncc"),
    ("SSIM", "obliq", "relit", "oblique_ssim"),
    ("slope", "deg", "angle", "gradient"),
    ("normal", "deg", "angle", "normal"),
    ("order", "local", "order", "local"),
    ("order", "all", "order", "overall"),
    ("lines", "seen", "visibility", "median"),
    ("lines", "cut", "visibility", "grooved"),
    ("depth", "used", "use", "span"),
    ("at", "bounds", "use", ("at_depth", "at_face")),
    ("DoG", "1 px", "detail", "s1"),
    ("DoG", "2 px", "detail", "s2"),
    ("DoG", "4 px", "detail", "s4"),
    ("DoG", "8 px", "detail", "s8"),
    ("un-", "reached", "carve", "beyond"),
    ("deg", "inside", "carve", "slope_inside"),
    ("deg", "walls", "carve", "slope_walls"),
)


def _cell(quality: Mapping[str, Mapping[str, float | None]], measure: str, names: Any) -> str:
    part = quality[measure]
    found = [part[name] for name in ([names] if isinstance(names, str) else names)]
    known = [value for value in found if value is not None]
    if len(known) < len(found):
        return "-"
    degrees = measure == "angle" or names in ("slope_inside", "slope_walls")
    return f"{sum(known):.1f}" if degrees else f"{sum(known):.3f}"


def table(reliefs: Sequence[Mapping[str, Any]]) -> str:
    """Write the figures of the reliefs one below the other.

    Parameters
    ----------
    reliefs : sequence of mapping
        Rows of `relieffab.job.compare.compare`.

    Returns
    -------
    str
        A line for each, '-' where a figure has no meaning, a blank line between depths.
    """
    heads = [("method", ""), ("depth", "mm"), *((top, below) for top, below, _, _ in COLUMNS)]
    body = [
        [
            relief["method"],
            f"{relief['depth_mm']:.2f}",
            *(_cell(relief["quality"], part, names) for _, _, part, names in COLUMNS),
        ]
        for relief in reliefs
    ]
    grid = [[head[k] for head in heads] for k in (0, 1)] + body
    widths = [max(len(row[k]) for row in grid) for k in range(len(heads))]
    lines = [
        "  ".join([f"{row[0]:<{widths[0]}}", *map(str.rjust, row[1:], widths[1:])]).rstrip()
        for row in grid
    ]
    depths = [None, None, *(relief["depth_mm"] for relief in reliefs)]
    spaced = [lines[0]]
    for k in range(1, len(lines)):
        spaced += ["", lines[k]] if depths[k] != depths[k - 1] else [lines[k]]
    return "\n".join(spaced)


def compare(
    source: Source,
    /,
    *,
    output: Annotated[
        Path | None, Parameter(name=["--output", "-o"], help="folder for the table and pictures")
    ] = None,
    depths: Annotated[str, Parameter(help="in percent of the figure's height")] = "2,5,10",
    flags: CompareFlags = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> int:
    """Make a model's relief by every method at several depths, and measure each."""
    settings = model_settings(source, flags)
    from relieffab.job import compare as job

    percents = job.percentages(depths)
    with console.progress_bar() as progress:
        report = job.compare(
            settings, output, depths=percents, overwrite=overwrite, progress=progress
        )
    for note in report["model"]["notes"]:
        console.message(f"note: {note}")
    if as_json:
        console.print_json(report)
        return 0
    print(table(report["reliefs"]))
    if output is not None:
        print(f"\ntable    {output / job.TABLE}\npicture  {output / job.SHEET}")
    return 0
