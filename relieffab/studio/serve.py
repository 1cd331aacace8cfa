"""Serve: the studio on this computer's own address, until it is interrupted."""

import errno
import logging
import socket
import webbrowser
from collections.abc import Callable, Mapping
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

from relieffab.errors import InputError
from relieffab.job.seen import check_settings
from relieffab.job.settings import Chosen, job_of
from relieffab.layers.content import content_of
from relieffab.studio.app import make_app
from relieffab.studio.desk import Desk
from relieffab.studio.guard import Guard, new_token
from relieffab.studio.session import OF_FILES

if TYPE_CHECKING:
    import uvicorn

HOST = "127.0.0.1"
BACKLOG = 64


def listening(port: int) -> socket.socket:
    """Take a port of the loopback; 0 for any.

    Raises
    ------
    InputError
        If another program has it, or it may not be taken.
    """
    taken = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        taken.bind((HOST, port))
        taken.listen(BACKLOG)
    except (OSError, OverflowError) as fault:
        taken.close()
        used = isinstance(fault, OSError) and fault.errno == errno.EADDRINUSE
        raise InputError(
            f"port {port} is in use by another program" if used else f"port {port} cannot be taken",
            found="" if used else str(fault),
            where="--port",
            hint="another --port, or 0 for any that is free",
        ) from fault
    return taken


def serve(
    chosen: Mapping[str, Chosen],
    output: Path,
    *,
    port: int,
    browser: bool,
    announce: Callable[[str], None],
) -> None:
    """Serve one studio until it is interrupted.

    Parameters
    ----------
    chosen : mapping of Chosen
        Settings to begin with; a model among them is opened first.
    output : Path
    port : int
    browser : bool
        Whether to open one.
    announce : callable
        Told the address.

    Raises
    ------
    InputError
        If the port cannot be taken or the model cannot be read.
    """
    import uvicorn

    with listening(port) as taken:
        port, token = taken.getsockname()[1], new_token()
        desk = Desk(chosen, output)
        try:
            _open(desk, chosen)
            address = f"http://{HOST}:{port}/{token}/"
            guarded = Guard(make_app(desk), token=token, port=port)
            config = uvicorn.Config(
                guarded, log_level=logging.WARNING, access_log=False, lifespan="off",
                timeout_graceful_shutdown=1, server_header=False,
            )  # fmt: skip
            announce(address)
            desk.warm()
            if browser:
                webbrowser.open(address)
            _server(config, desk).run(sockets=[taken])
        except KeyboardInterrupt:
            return
        finally:
            desk.close()


def _open(desk: Desk, chosen: Mapping[str, Chosen]) -> None:
    """Open the model that was named, and its mask."""
    if chosen["model"].value is not None:
        file = Path(chosen["model"].value).resolve()
        check_settings(job_of(chosen), content_of(file))
        desk.open(file, **{name: chosen[name].text for name in OF_FILES if name != "mask"})
    if chosen["mask"].value is not None:
        desk.open_mask(Path(chosen["mask"].value).resolve())


def _server(config: "uvicorn.Config", desk: Desk) -> "uvicorn.Server":
    """Make a server that lets go of those who wait before it waits for them."""
    import uvicorn

    class Server(uvicorn.Server):
        def handle_exit(self, sig: int, frame: FrameType | None) -> None:
            desk.stop()
            # What is cut short from now on is so by the person's own wish.
            logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)
            super().handle_exit(sig, frame)

    return Server(config)
