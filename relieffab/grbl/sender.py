"""Send a program through a port and see it through."""

from collections.abc import Iterable
from dataclasses import replace

from relieffab.errors import InputError
from relieffab.grbl.company import Company, SendReport
from relieffab.grbl.drive import Drive
from relieffab.grbl.job import Job
from relieffab.grbl.port import Port
from relieffab.grbl.program import prepare
from relieffab.grbl.stage import Patience

__all__ = ["Company", "SendReport", "send"]


def send(
    program: Job | str | Iterable[str],
    port: Port,
    company: Company | None = None,
    *,
    patience: Patience | None = None,
) -> SendReport:
    """Send a program and wait until the machine has carried it out.

    The whole program is checked before the first byte goes out.  Whatever ends the job
    early (a fault, Ctrl-C, an exception out of `company`) holds the machine, resets it and
    makes sure that its spindle is off before this function is left.

    Parameters
    ----------
    program : Job, str or iterable of str
        What to do; text or its lines are carved from the first to the last.
    port : Port
        Freshly opened: the machine's greeting may still be to come.
    company : Company, optional
    patience : Patience, optional

    Raises
    ------
    InputError
        If a line must not be sent; nothing has moved.
    MachineError
        If the machine refuses, raises an alarm, restarts, falls silent or is unplugged,
        with the line reached and Grbl's own meaning.
    """
    with_whom = company or Company()
    job = program if isinstance(program, Job) else Job(prepare(program))
    job = replace(job, attended=with_whom.typed is not None)
    if job.program.pauses and not (job.attended or job.check):
        raise InputError(
            "the program waits for a person (M0), and nobody is there to let it go on",
            where=f"line {job.program.pauses[0]}",
            hint="take M0 out, or send from a terminal",
        )
    return Drive(job, port, with_whom, patience or Patience()).run()
