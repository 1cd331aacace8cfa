"""relieffab: the command line.

Exit status: 0 done, 1 findings, 2 bad input or usage, 3 machine, 130 interrupted.
"""

import os
import sys
from collections.abc import Sequence

from cyclopts import App, CycloptsError

from relieffab import __version__
from relieffab.cli import batch, comparison, composing, first, stages
from relieffab.cli.interrupt import listen
from relieffab.cli.machines import machines
from relieffab.cli.send import send
from relieffab.cli.showing import show
from relieffab.cli.studio import studio
from relieffab.errors import RelieffabError

app = App(
    name="relieffab",
    help="From a 3D model to a carved sunken relief.",
    version=__version__,
    help_format="plaintext",
    result_action="return_value",
    suppress_keyboard_interrupt=False,
)
for command in (
    first.demo,
    stages.make,
    first.init,
    stages.layers,
    stages.relief,
    stages.panel,
    stages.template,
    stages.toolpath,
    stages.verify,
    composing.compose,
    comparison.compare,
    batch.batch,
    studio,
    send,
    show,
):
    app.command(command)
app.command(machines)


def run(arguments: Sequence[str]) -> int:
    """Carry out one command line and return its exit status."""
    try:
        status = app(list(arguments), exit_on_error=False, print_error=True)
        sys.stdout.flush()
    except CycloptsError:
        return 2
    except RelieffabError as error:
        print(f"relieffab: {error}", file=sys.stderr)
        return error.exit_status
    except BrokenPipeError:
        # Who read the output has seen enough; nothing more can be said there.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as error:
        print(f"relieffab: {error.strerror or error}\n  where: {error.filename}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as stopped:
        for note in getattr(stopped, "__notes__", ["interrupted; nothing half-written is left"]):
            print(f"relieffab: {note}", file=sys.stderr)
        return 130
    return status if isinstance(status, int) else 0


def main() -> None:
    """Serve as the console script."""
    listen()
    sys.exit(run(sys.argv[1:]))
