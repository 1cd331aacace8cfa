"""The folder a job leaves: either whole or not at all."""

import contextlib
import os
import secrets
import shutil
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path

from relieffab.errors import InputError
from relieffab.panel.formats import FORMATS, FRAME, STOCK

REPORT = "report.json"

# What each stage leaves, in their order; patterns where the count varies.
LAYERS = ("layers/depth.png", "layers/lambert.png", "layers/lines.png", "layers/lines.svg")
SMOOTH = "smooth.tiff"
MARKS = (SMOOTH, "layers/marks.svg", "layers/marks-[0-9]*.svg")
WALLS = "walls.tiff"
RELIEF = ("relief.tiff", "relief.png", WALLS, "preview.png")
SOLIDS = {
    name: (
        *(f"{name}.{kind}" for kind in FORMATS),
        *(f"{name}-[A-Z][1-9].{kind}" for kind in FORMATS),
        *(f"{name}-[A-Z][1-9][0-9].{kind}" for kind in FORMATS),
        *([] if name == "panel" else [f"{name}.png"]),
    )
    for name in ("panel", "plaque", "mould")
}
_NC = (
    "00-outline.nc",
    "00-probe.nc",
    "01-rough.nc",
    "02-finish.nc",
    "03-lines.nc",
    "04-marks.nc",
    "[0-9][0-9]-marks-[0-9]*.nc",
    "programs.nc",
)
PROGRAMS = (
    *_NC,
    *(f"[1-9]-{name}" for name in _NC),
    *(f"[1-9][0-9]-{name}" for name in _NC),
    *("deviation.png", "look.png"),
)
TEMPLATE = ("template.svg", "template.pdf", "contours.svg")
ALL = (
    *(*LAYERS, *MARKS, *RELIEF, *chain.from_iterable(SOLIDS.values()), STOCK, FRAME),
    *(*PROGRAMS, *TEMPLATE, "report.html"),
)


def check_folder(folder: Path, *, overwrite: bool) -> None:
    """Refuse a folder that could not take the job, before any work is done.

    Raises
    ------
    InputError
        If it is a file, already holds something, or cannot be written.
    """
    for path in (folder, *folder.parents):
        if path.exists() and not path.is_dir():
            raise InputError("the output is a file, not a folder", where=str(path))
    if folder.is_dir() and any(folder.iterdir()) and not overwrite:
        holds = "a job" if (folder / REPORT).exists() else "files"
        raise InputError(
            f"the output folder already holds {holds}",
            where=str(folder),
            hint="another -o, or --overwrite to replace the files of the job",
        )
    parent = next(p for p in (folder, *folder.resolve().parents) if p.is_dir())
    if not os.access(parent, os.W_OK):
        raise InputError("the output folder cannot be written", where=str(parent))


@contextlib.contextmanager
def finished_together(
    folder: Path, stale: Sequence[str] = (), *, last: str = REPORT
) -> Iterator[Path]:
    """Give a scratch folder whose files move to `folder` when all went well.

    The scratch folder lies in it or beside it, so that moving is renaming.  The
    old report goes first and the new one comes last: a folder that has one is
    whole.  After an exception nothing of the scratch folder stays.

    Parameters
    ----------
    folder : Path
    stale : sequence of str
        Files, or patterns of them, that no longer belong to the job unless they
        are made again.
    last : str
        The report's name.
    """
    folder = folder.resolve()
    home = next(path for path in (folder, *folder.parents) if path.is_dir())
    scratch = home / f".{folder.name}-{secrets.token_hex(4)}"
    try:
        scratch.mkdir(mode=0o700)  # in here: a stop may come as soon as it is there
        yield scratch
        for path in [path for name in (last, *stale) for path in folder.glob(name)]:
            path.unlink(missing_ok=True)
        for source in sorted(scratch.rglob("*"), key=lambda path: (path.name == last, path)):
            target = folder / source.relative_to(scratch)
            if source.is_dir():
                target.mkdir(parents=True, exist_ok=True)
            else:
                target.parent.mkdir(parents=True, exist_ok=True)
                source.replace(target)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
