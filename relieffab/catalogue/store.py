"""batch.json and index.html: what became of each job, written so that neither is ever half."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from relieffab import __version__
from relieffab.catalogue.index import index
from relieffab.catalogue.rows import DONE, FAILED, KEPT, WAITING, Row
from relieffab.errors import InputError
from relieffab.job.folder import REPORT, check_folder

TABLE, PAGE = "batch.json", "index.html"
SCHEMA = 1


def summary(folder: Path, stage: str, rows: Sequence[Row], seconds: float) -> dict[str, Any]:
    """Sum a batch up, as batch.json holds it."""
    count = Counter(row["status"] for row in rows)
    return {
        "schema": SCHEMA,
        "version": __version__,
        "title": folder.resolve().name,
        "stage": stage,
        "seconds": round(seconds, 3),
        **{status: count[status] for status in (DONE, KEPT, FAILED, WAITING)},
        "others": strangers(folder, rows),
        "findings": sum(bool(row.get("findings")) for row in rows),
        "jobs": list(rows),
    }


def strangers(folder: Path, rows: Sequence[Row]) -> list[str]:
    """Name the jobs in a catalogue that belong to none of these rows: of other lists, say."""
    known = {row["name"] for row in rows}
    names = sorted(path.parent.name for path in folder.glob(f"*/{REPORT}"))
    return [name for name in names if name not in known]


def write(batch: Mapping[str, Any], folder: Path) -> None:
    """Write table and page into the catalogue, each in place of the last one."""
    text = json.dumps(batch, indent=2, ensure_ascii=False, allow_nan=False)
    for name, content in ((TABLE, text + "\n"), (PAGE, index(batch))):
        beside = folder / f".{name}.part"
        beside.write_text(content, encoding="utf-8")
        beside.replace(folder / name)


def check_catalogue(folder: Path) -> None:
    """Refuse a folder that could not take the batch, or holds something else.

    Raises
    ------
    InputError
        If it is a file, cannot be written, or holds what no batch has left.
    """
    begun = (folder / TABLE).is_file()
    check_folder(folder, overwrite=True)
    if folder.is_dir() and not begun and any(not p.name.startswith(".") for p in folder.iterdir()):
        raise InputError(
            "the output folder holds files, but no batch",
            where=str(folder),
            hint="another -o; a batch goes on in the folder that it has begun itself",
        )
