"""App: the studio's routes, each a thin word to the session."""

import asyncio
import json
import math
import shutil
from collections.abc import Awaitable, Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import (
    FileResponse,
    JSONResponse,
    PlainTextResponse,
    Response,
    StreamingResponse,
)
from starlette.routing import Route

from relieffab.errors import InputError, RelieffabError
from relieffab.studio import upload
from relieffab.studio.controls import OFFERED
from relieffab.studio.desk import Desk
from relieffab.studio.exporting import BusyError
from relieffab.studio.worker import SupersededError

PAGE = Path(__file__).parent / "page"
LARGEST_JSON = 1 << 20
"""Bytes of an ask."""
SANDBOX = "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:"
"""For a report, which comes with a style of its own."""

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".png": "image/png",
}


def make_app(desk: Desk) -> Starlette:
    """Put the routes together."""
    routes = _Routes(desk)
    table: dict[str, tuple[str, Callable[[Request], Awaitable[Response]]]] = {
        "/": ("GET", routes.index),
        "/page/{path:path}": ("GET", routes.page),
        "/state": ("GET", routes.state),
        "/model": ("POST", routes.model),
        "/mask": ("POST", routes.mask),
        "/mesh": ("GET", routes.mesh),
        "/preview": ("POST", routes.preview),
        "/panel": ("POST", routes.panel),
        "/toolpaths": ("POST", routes.toolpaths),
        "/carved": ("GET", routes.carved),
        "/export": ("POST", routes.export),
        "/cancel": ("POST", routes.cancel),
        "/events": ("GET", routes.events),
        "/result/{path:path}": ("GET", routes.result),
        "/job.toml": ("GET", routes.job_file),
    }
    return Starlette(
        routes=[Route(path, call, methods=[method]) for path, (method, call) in table.items()],
        exception_handlers={
            RelieffabError: _told,
            SupersededError: _superseded,
        },
    )


def _fault(error: RelieffabError) -> dict[str, str]:
    """Put an error into words for the page, with the setting it is about."""
    where = error.parts.get("where", "")
    setting = {"setting": where} if where in OFFERED else {}
    return {"message": error.message, **error.parts, **setting}


async def _told(_request: Request, error: Exception) -> Response:
    assert isinstance(error, RelieffabError)
    return JSONResponse({"error": _fault(error)}, 422)


async def _superseded(_request: Request, _error: Exception) -> Response:
    return JSONResponse({"superseded": True}, 409)


def _frame(body: bytes) -> Response:
    return Response(body, media_type="application/octet-stream")


async def _asked(request: Request) -> dict[str, Any]:
    """Read an ask: a JSON object that is not too large."""
    body = bytearray()
    async for part in request.stream():
        body += part
        if len(body) > LARGEST_JSON:
            raise InputError("the ask is too large", expected=f"at most {LARGEST_JSON} bytes")
    try:
        asked = json.loads(bytes(body) or b"{}")
    except ValueError as fault:
        raise InputError("the ask is not JSON", found=str(fault)) from fault
    if not isinstance(asked, dict) or not isinstance(asked.get("settings", {}), dict):
        raise InputError("the ask is not an object with settings")
    return asked


class _Routes:
    def __init__(self, desk: Desk) -> None:
        self._desk = desk

    async def index(self, _request: Request) -> Response:
        return self._static("index.html")

    async def page(self, request: Request) -> Response:
        return self._static(request.path_params["path"])

    def _static(self, name: str) -> Response:
        path = (PAGE / name).resolve()
        kind = _TYPES.get(path.suffix)
        if PAGE not in path.parents or kind is None or not path.is_file():
            return PlainTextResponse("not here", 404)
        return Response(path.read_bytes(), headers={"Content-Type": kind})

    async def state(self, _request: Request) -> Response:
        return JSONResponse(await run_in_threadpool(self._desk.state))

    async def model(self, request: Request) -> Response:
        """Take a model as it streams in."""
        name = request.query_params.get("name", "")
        if name == "scarab":
            await run_in_threadpool(self._desk.open_scarab)
            return await self.state(request)
        await self._uploaded(request, self._desk.session.new_place(), self._desk.open)
        return await self.state(request)

    async def mask(self, request: Request) -> Response:
        """Take a picture's mask."""
        place = self._desk.session.new_place()
        name = await self._uploaded(request, place, self._desk.open_mask)
        await run_in_threadpool(shutil.rmtree, place, ignore_errors=True)  # it is kept elsewhere
        return JSONResponse({"mask": name})

    async def _uploaded(self, request: Request, place: Path, take: Callable[[Path], Any]) -> Any:
        """Receive a file into a place of its own, which is taken away if it is not taken."""
        try:
            file = place / upload.safe_name(request.query_params.get("name", ""))
            length = request.headers.get("content-length", "0")
            upload.refuse_size(int(length) if length.isdigit() else 0)
            await _receive(request, file)
            return await run_in_threadpool(take, file)
        except BaseException:
            await run_in_threadpool(shutil.rmtree, place, ignore_errors=True)
            raise

    async def mesh(self, _request: Request) -> Response:
        return _frame(await run_in_threadpool(self._desk.mesh))

    async def preview(self, request: Request) -> Response:
        return await self._worked_out(request, self._desk.preview)

    async def panel(self, request: Request) -> Response:
        return await self._worked_out(request, self._desk.panel)

    async def toolpaths(self, request: Request) -> Response:
        return await self._worked_out(request, self._desk.toolpaths)

    async def _worked_out(
        self, request: Request, ask: Callable[[dict[str, Any]], "Future[bytes]"]
    ) -> Response:
        return _frame(await asyncio.wrap_future(ask(await _asked(request))))

    async def carved(self, request: Request) -> Response:
        at = _moment(request.query_params.get("at", ""))
        return _frame(await asyncio.wrap_future(self._desk.carved(at)))

    async def export(self, request: Request) -> Response:
        asked = await _asked(request)
        try:
            state = await run_in_threadpool(self._desk.export, asked.get("settings", {}))
        except BusyError as error:
            return JSONResponse({"error": _fault(error)}, 409)
        return JSONResponse({"export": state}, 202)

    async def cancel(self, _request: Request) -> Response:
        await run_in_threadpool(self._desk.exporter.cancel)
        return JSONResponse({"export": self._desk.exporter.state})

    async def events(self, _request: Request) -> Response:
        first = {"export": self._desk.exporter.state}
        return StreamingResponse(self._desk.events.listen(first), media_type="text/event-stream")

    async def result(self, request: Request) -> Response:
        path = self._desk.exporter.file(request.path_params["path"])
        headers = {"Content-Security-Policy": SANDBOX} if path.suffix == ".html" else {}
        kind = _TYPES.get(path.suffix, "application/octet-stream")
        return FileResponse(path, media_type=kind, headers=headers)

    async def job_file(self, _request: Request) -> Response:
        text = self._desk.session.job_file()
        headers = {"Content-Disposition": 'attachment; filename="job.toml"'}
        return Response(text, media_type="application/toml", headers=headers)


def _moment(text: str) -> float:
    try:
        at = float(text)
    except ValueError:
        at = math.nan
    if not math.isfinite(at):
        raise InputError("that is no moment", expected="seconds", found=repr(text[:40]))
    return at


async def _receive(request: Request, file: Path) -> None:
    """Write what streams in to a file, counting."""
    count = 0
    with file.open("wb") as out:
        async for part in request.stream():
            count += len(part)
            upload.refuse_size(count)
            await run_in_threadpool(out.write, part)
