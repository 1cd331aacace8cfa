"""Lists of jobs as people keep them: a table (CSV), TOML, or a model a line."""

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from relieffab.errors import InputError, suggest
from relieffab.job.load import Source, beside, job_source, read_toml
from relieffab.job.settings import resolve
from relieffab.job.table import TABLE

LISTS = (".csv", ".toml", ".txt")
JOBS = "job"  # a list in TOML has a [[job]] for each
BESIDE = ("model", "name", "note")


@dataclass(frozen=True)
class Wanted:
    """A job as somebody asked for it.

    Parameters
    ----------
    where : str
        The file that asks for it, and the line where it has lines.
    model : str
        The model's path, as it is found from here.
    files : tuple of Source
        What files say of its settings, the strongest first.
    name, note : str
        What it is to be called, and what is to be read beside it.
    fault : str
        Why it cannot be asked for like that.
    """

    where: str
    model: str
    files: tuple[Source, ...] = ()
    name: str = ""
    note: str = ""
    fault: str = ""


def read_list(path: Path) -> list[Wanted]:
    """Read the jobs of a list; a TOML file without [[job]] is the file of one job.

    Models, and other files that jobs name, are looked for beside the list.

    Raises
    ------
    InputError
        If the list itself cannot be read; what is wrong with one job is its `fault`.
    """
    suffix = path.suffix.lower()
    if suffix == ".csv":
        return list(_table(path))
    if suffix == ".txt":
        return list(_lines(path))
    values = read_toml(path)
    return list(_tables(path, values)) if JOBS in values else [_of_job_file(path)]


def wants_jobs(path: Path) -> bool:
    """Tell whether a TOML file asks for jobs, or is about something else; unreadable ones do."""
    try:
        values = read_toml(path)
    except InputError:
        return True
    return bool({"model", JOBS} & set(values))


def of_model(path: Path) -> Wanted:
    """Ask for a model as it is."""
    return Wanted(str(path), str(path), (("model", {"model": str(path)}),))


def _of_job_file(path: Path) -> Wanted:
    source = job_source(path)
    return Wanted(str(path), str(source[1].get("model", "")), (source,), path.stem)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as fault:
        raise InputError(
            "the list cannot be read",
            expected="text in UTF-8",
            found=str(fault),
            where=str(path),
            hint="save it as CSV UTF-8",
        ) from fault


def _lines(path: Path) -> Iterator[Wanted]:
    for number, line in enumerate(_text(path).splitlines(), 1):
        model = line.strip()
        if model and not model.startswith("#"):
            yield _row(f"{path}, line {number}", {"model": model}, path.parent)


def _table(path: Path) -> Iterator[Wanted]:
    """Read a table with commas, semicolons or tabs, whichever part its heading."""
    lines = _text(path).splitlines()
    heading = next((line for line in lines if line.strip()), "")
    rows = csv.DictReader(lines, delimiter=max(",;\t", key=heading.count), skipinitialspace=True)
    columns = [name.strip().lower().replace("-", "_") for name in rows.fieldnames or ()]
    _check_columns(columns, path)
    rows.fieldnames = columns
    for row in rows:
        where = f"{path}, line {rows.line_num}"
        more = row.pop(None, None)  # type: ignore[call-overload]
        values = {name: text.strip() for name, text in row.items() if text and text.strip()}
        if more and values:
            found = f"{len(columns)} columns, {len(columns) + len(more)} cells"
            fault = InputError(
                "the line has more cells than the table has columns",
                found=found,
                where=where,
                hint='quotes around what holds the separator: "10x80mm, 110x80mm"',
            )
            yield Wanted(where, values.get("model", ""), fault=str(fault))
        elif values:
            yield _row(where, values, path.parent)


def _check_columns(columns: list[str], path: Path) -> None:
    known = (*BESIDE, *TABLE)
    if "model" not in columns:
        raise InputError(
            "the list does not say which models",
            expected="a heading with a column 'model'; others are settings, 'name' and 'note'",
            found=", ".join(columns) or "an empty file",
            where=str(path),
        )
    for name in columns:
        if name not in known:
            raise InputError(
                f"there is no setting {name!r} for a column of this list",
                where=str(path),
                hint=f"{suggest(name, known)} (remarks go into a column 'note')",
            )


def _tables(path: Path, values: dict[str, Any]) -> Iterator[Wanted]:
    """Read the [[job]]s of a list in TOML; what stands before them serves them all."""
    jobs = values.pop(JOBS)
    common = (str(path), values)
    resolve([common])
    if not isinstance(jobs, list) or not all(isinstance(job, dict) for job in jobs):
        raise InputError(
            "this is not a list of jobs", expected="[[job]] before each", where=str(path)
        )
    for k, job in enumerate(jobs, 1):
        wanted = _row(f"{path}, job {k}", job, path.parent)
        yield replace(wanted, files=(*wanted.files, common))


def _row(where: str, values: Mapping[str, Any], folder: Path) -> Wanted:
    model, name, note = (str(values.get(key, "")) for key in BESIDE)
    rest = {key: value for key, value in values.items() if key not in BESIDE}
    rest = beside(folder, rest)
    if not model:
        fault = InputError("the job names no model", expected="a model file", where=where)
        return Wanted(where, "", name=name, note=note, fault=str(fault))
    path = folder / model
    if path.suffix.lower() != ".toml":
        files: tuple[Source, ...] = ((where, {**rest, "model": str(path)}),)
        return Wanted(where, str(path), files, name, note)
    try:
        job = _of_job_file(path)
    except InputError as fault:
        return Wanted(where, str(path), name=name, note=note, fault=str(fault))
    return replace(
        job, where=where, files=((where, rest), *job.files), name=name or job.name, note=note
    )
