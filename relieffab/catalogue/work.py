"""One job of a batch, carried out: the function that every worker runs, wherever it is."""

import os
import platform
import threading
import time

from relieffab import __version__
from relieffab.catalogue.identity import finished, key_of
from relieffab.catalogue.lock import holds
from relieffab.catalogue.task import Fault, Result, Task
from relieffab.catalogue.thumbnail import THUMBNAIL, thumbnail
from relieffab.errors import InputError, RelieffabError
from relieffab.job.folder import ALL, finished_together
from relieffab.job.report import Report, write_report
from relieffab.progress import Progress

_MAKERS = {"layers": "make_layers", "relief": "make_relief", "make": "make"}

# A worker of a cluster may have several threads; kernels use them all for one job.
_one_at_a_time = threading.Lock()


def carry_out(task: Task) -> Result:
    """Do a job, unless it is done: all of its files or none.

    Returns
    -------
    dict or Fault
        What its report.json holds.
    """
    with _one_at_a_time:
        try:
            return _carried_out(task)
        except RelieffabError as fault:
            return Fault(str(fault))
        except OSError as fault:
            where = f"\n  where: {fault.filename}" if fault.filename else ""
            return Fault(f"{fault.strerror or fault}{where}")
        except MemoryError:
            return Fault(
                "there was not enough memory\n  try: a lower resolution, or fewer --workers"
            )


def _carried_out(task: Task) -> Report:
    _check_here(task)
    done = finished(task.folder, task.stage, task.key, task.model)
    if done is not None:
        return done
    from relieffab.job import run

    start = time.perf_counter()
    going = _while_it_lasts(task)
    with finished_together(task.folder, (*ALL, THUMBNAIL)) as scratch:
        report: Report = getattr(run, _MAKERS[task.stage])(task.settings, scratch, progress=going)
        seconds = round(time.perf_counter() - start, 3)
        report["batch"] = {
            "key": task.key,
            "stage": task.stage,
            "seconds": seconds,
            "worker": f"process {os.getpid()} on {platform.node()}",
        }
        write_report(report, scratch)
        (scratch / THUMBNAIL).write_bytes(thumbnail(scratch))
        going("batch", 1, 1)
    return report


def _check_here(task: Task) -> None:
    """Refuse to work where the batch cannot be seen, or would come out otherwise."""
    here = platform.node()
    _check_lasts(task)
    if not task.model.parent.is_dir():
        raise InputError("the model's folder is not there", where=f"{task.model} on {here}")
    if key_of(task.settings) != task.key:
        raise InputError(
            "this worker would make something else of the job",
            expected="the version and the profiles of where the batch was started",
            found=f"relieffab {__version__} and its profiles",
            where=here,
            hint="the same relieffab and the same user configuration on every machine",
        )


def _check_lasts(task: Task) -> None:
    if not holds(task.catalogue, task.token):
        raise InputError(
            "the batch has ended, or its folder is not to be seen",
            where=f"{task.catalogue} on {platform.node()}",
            hint="models and results on a disk that every machine sees under the same path",
        )


def _while_it_lasts(task: Task) -> Progress:
    """Stop the job at the next sign of progress once its batch has ended."""

    def heed(stage: str, done: float, total: float, unit: str = "") -> None:  # noqa: ARG001
        _check_lasts(task)

    return heed
