"""A name for each job, fit for a folder, and no two alike."""

from collections.abc import Sequence
from pathlib import PurePath

from relieffab.catalogue.lists import Wanted

LONGEST = 80
TAKEN = ("index.html", "batch.json")


def distinct_names(jobs: Sequence[Wanted]) -> list[str]:
    """Name the jobs: as asked, or by their models; by more of the path where that is not enough.

    Names that differ by case alone count as alike: some disks cannot tell them apart.

    Examples
    --------
    >>> distinct_names([Wanted("", path) for path in ("a/horse.ply", "b/horse.ply", "b/cow.obj")])
    ['a-horse', 'b-horse', 'cow']
    """
    spelled = [[_fit(way) for way in _ways(job)] for job in jobs]
    level = [0] * len(jobs)
    while alike := _alike([ways[k] for ways, k in zip(spelled, level, strict=True)], jobs):
        more = [i for i in alike if level[i] + 1 < len(spelled[i])]
        if not more:
            break
        for i in more:
            level[i] += 1
    return _numbered([ways[k] for ways, k in zip(spelled, level, strict=True)])


def _ways(job: Wanted) -> list[str]:
    """Spell a job's name, shorter ways first."""
    path = PurePath(job.model or job.where)
    if job.name:
        return [job.name]
    parent, stem, kind = path.parent.name, path.stem, path.suffix[1:]
    ways = [stem, f"{stem}-{kind}"]
    return [*ways, *(f"{parent}-{way}" for way in ways)] if parent else ways


def _fit(name: str) -> str:
    """Leave out what a folder's name should not hold, and what would hide it."""
    kept = "".join(c if c.isprintable() and c not in '/\\:*?"<>|' else "-" for c in name.strip())
    return kept.lstrip(".-").rstrip(". ")[:LONGEST] or "model"


def _alike(names: Sequence[str], jobs: Sequence[Wanted]) -> list[int]:
    """List the jobs whose names also stand for another model, or for the catalogue's files."""
    models: dict[str, set[str]] = {name: {""} for name in TAKEN}
    for name, job in zip(names, jobs, strict=True):
        models.setdefault(name.casefold(), set()).add(job.model or job.where)
    return [i for i, name in enumerate(names) if len(models[name.casefold()]) > 1]


def _numbered(names: Sequence[str]) -> list[str]:
    """Give numbers to those that are still alike, but for the first."""
    used, made = set(TAKEN), []
    for name in names:
        number, tried = 1, name
        while tried.casefold() in used:
            number += 1
            tried = f"{name}-{number}"
        used.add(tried.casefold())
        made.append(tried)
    return made
