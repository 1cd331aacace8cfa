"""From what a person names, folders, lists and models, to the jobs that are wanted."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from relieffab.catalogue.lists import LISTS, Wanted, of_model, read_list, wants_jobs
from relieffab.errors import InputError
from relieffab.job.folder import REPORT
from relieffab.job.load import FILES
from relieffab.layers.content import MESH, PICTURE, SVG, content_of
from relieffab.layers.mesh import USUAL_UP


def wanted(sources: Sequence[str], output: Path) -> list[Wanted]:
    """Gather the jobs of all sources, in their order.

    Parameters
    ----------
    sources : sequence of str
        Folders (every mesh in them, however deep, and every job file; pictures where there
        is no mesh, for beside one they may be textures), lists, job files, models.
    output : Path
        Where results go: nothing in there is a model to carve.

    Raises
    ------
    InputError
        If a source is not there, is nothing of the kind, or holds no job.
    """
    found = [job for source in sources for job in _of(Path(source), output.resolve())]
    if not found:
        raise InputError(
            "there is nothing to carve",
            expected=f"models ({' '.join(USUAL_UP)}), pictures or job files (.toml)",
            where=", ".join(sources),
        )
    return found


def _of(path: Path, output: Path) -> list[Wanted]:
    suffix = path.suffix.lower()
    if path.is_dir():
        return _of_folder(path, output)
    if not path.is_file():
        raise InputError("there is no such folder or list", where=str(path))
    if suffix in LISTS:
        return read_list(path)
    if suffix in USUAL_UP or content_of(path) != MESH:
        return [of_model(path)]
    raise InputError(
        "this is neither a folder nor a list nor a model",
        expected=" ".join((*LISTS, *USUAL_UP)),
        found=repr(path.suffix),
        where=str(path),
    )


def _of_folder(folder: Path, output: Path) -> list[Wanted]:
    """Take every mesh of a folder, or every picture, but those that a job file in it speaks for."""
    files = list(_files(folder, output))
    jobs = [job for path in files if path.suffix.lower() == ".toml" for job in _of_toml(path)]
    spoken_for = {path.resolve() for job in jobs for path in _named(job)}
    models = [path for path in files if path.suffix.lower() in USUAL_UP]
    models = models or [path for path in files if content_of(path) in (PICTURE, SVG)]
    return [*jobs, *(of_model(path) for path in models if path.resolve() not in spoken_for)]


def _named(job: Wanted) -> list[Path]:
    """Name the files that a job takes: its model, a mask, a depth map."""
    values = [job.model, *(values.get(name) for _, values in job.files for name in FILES)]
    return [Path(value) for value in values if value]


def _of_toml(path: Path) -> list[Wanted]:
    """Read a job file found in a folder; one that cannot be read is a job that fails."""
    if not wants_jobs(path):
        return []
    try:
        return read_list(path)
    except InputError as fault:
        return [Wanted(str(path), "", name=path.stem, fault=str(fault))]


def _files(folder: Path, output: Path) -> Iterator[Path]:
    """Walk a folder, by name; not into hidden folders, nor into what jobs have left."""
    for place, folders, names in os.walk(folder):
        here = Path(place)
        if here.resolve() == output or REPORT in names:
            folders.clear()
            continue
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        yield from (here / name for name in sorted(names) if not name.startswith("."))
