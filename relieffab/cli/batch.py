"""batch: many jobs into one folder, with a page that shows them all."""

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from relieffab import units
from relieffab.cli import console
from relieffab.cli.options import Flags, Json, given
from relieffab.errors import InputError

if TYPE_CHECKING:
    from relieffab.catalogue.engine import Engine
    from relieffab.catalogue.task import Task

WORDS = {"done": "done", "kept": "kept", "failed": "FAILED"}
SHARE = 0.8  # of the machine's memory, where no other is asked for


def batch(
    *sources: Annotated[
        str, Parameter(help="folders of models, lists (.csv, .toml, .txt), job files, models")
    ],
    output: Annotated[
        Path, Parameter(name=["--output", "-o"], help="folder for the catalogue, a folder a job")
    ],
    stage: Annotated[
        Literal["layers", "relief", "make"],
        Parameter(help="how far each job goes, as the command of that name"),
    ] = "make",
    workers: Annotated[
        int | None, Parameter(help="jobs at once on this machine (default: its cores)")
    ] = None,
    memory: Annotated[
        str | None, Parameter(help="for all jobs at once, as 4GiB (default: 80 % of what there is)")
    ] = None,
    scheduler: Annotated[
        str | None, Parameter(help="of a Dask cluster that does the work, as tcp://host:8786")
    ] = None,
    flags: Flags = None,
    as_json: Json = False,
) -> int:
    """Carve many models: a folder each, and a page to look them through.

    The same command again goes on where it was stopped: what is finished is kept.

    Exit status: 0 all done, 1 some failed or have findings.
    """
    if not sources:
        raise InputError("there is nothing to carve", expected="a folder, a list or models")
    from relieffab.catalogue import run
    from relieffab.catalogue.entries import entries
    from relieffab.catalogue.listing import wanted

    engine = _engine(workers, memory, scheduler)
    jobs = entries(wanted(sources, output), given(flags), os.environ, stage)
    with console.progress_bar() as progress:
        found = run.batch(
            jobs,
            output,
            stage,
            engine,
            tell=_teller(len(jobs), as_json=as_json),
            progress=progress,
        )
    if as_json:
        console.print_json(found)
    else:
        _sum(found, output)
    return 1 if found["failed"] or found["findings"] else 0


def _engine(
    workers: int | None, memory: str | None, scheduler: str | None
) -> "Callable[[Sequence[Task]], AbstractContextManager[Engine]]":
    """Choose who does the work; what is asked for is read at once, begun when there is work."""
    from relieffab.catalogue.processes import Processes, cores, machine_memory

    if scheduler is not None:
        if workers is not None or memory is not None:
            raise InputError(
                "--workers and --memory are about this machine, --scheduler about others",
                hint="dask worker --nworkers and --memory-limit say it there",
            )
        from relieffab.catalogue.cluster import Cluster

        return lambda _: Cluster(scheduler, tell=console.message)
    if workers is not None and workers < 1:
        raise InputError("there must be a worker", found=str(workers), where="--workers")
    room = units.memory(memory) if memory is not None else int(SHARE * machine_memory())

    def processes(tasks: "Sequence[Task]") -> Processes:
        fit = max(1, room // min(task.memory for task in tasks))
        return Processes(min(workers or cores(), len(tasks), fit), room)

    return processes


def _teller(count: int, *, as_json: bool) -> Callable[[Mapping[str, Any]], None]:
    """Return what prints a line for each job: beside the JSON, or as the result."""
    stream, known = sys.stderr if as_json else sys.stdout, 0

    def tell(row: Mapping[str, Any]) -> None:
        nonlocal known
        known += 1
        number = f"{known:>{len(str(count))}} of {count}"
        print(f"{number}  {line(row)}", file=stream, flush=True)

    return tell


def line(row: Mapping[str, Any]) -> str:
    """Write a job's row as a line: name, what became of it, and in how much time."""
    head = f"{row['name']:<24} {WORDS[row['status']]:<6}"
    if row["status"] == "failed":
        return f"{head}  {row['message'].splitlines()[0]}"
    from relieffab.catalogue.index import verdict
    from relieffab.job.sheet.words import clock

    facts = ["{:g} x {:g} mm".format(*row["size_mm"]), verdict(row)]
    if row["cutting_s"] is not None:
        facts.append(f"{clock(row['cutting_s'])} to cut")
    if row["status"] == "done":
        facts.append(f"made in {row['seconds']:.1f} s")
    return f"{head}  {', '.join(facts)}"


def _sum(found: Mapping[str, Any], folder: Path) -> None:
    for row in found["jobs"]:
        if row["status"] == "failed":
            console.message(f"\n{row['name']}: {row['message']}")
    if found["others"]:
        names = ", ".join(found["others"])
        console.message(f"note: no job of this batch, and left as they are: {names}")
    known = {"done": "done", "kept": "done before", "failed": "failed"}
    counts = ", ".join(f"{found[key]} {word}" for key, word in known.items() if found[key])
    print(f"\n{len(found['jobs'])} jobs: {counts}")
    print(f"page     {folder / 'index.html'}")
