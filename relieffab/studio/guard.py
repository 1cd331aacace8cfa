"""Guard: who may talk to the studio, and what browsers may do with what it says."""

import secrets
from typing import Any

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

POLICY = (
    "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
    "object-src 'none'"
)
HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


def new_token() -> str:
    """Make a word that nobody guesses."""
    return secrets.token_urlsafe(24)


class Guard:
    """Lets through what comes from the studio's own page, and nothing else.

    A name that a stranger's site points at this computer comes with another Host (DNS
    rebinding), a stranger's page with another Origin; neither knows the token.

    Parameters
    ----------
    app : ASGI application
        Gets paths without the token.
    token : str
    port : int
        Where the studio is served.
    """

    def __init__(self, app: ASGIApp, *, token: str, port: int) -> None:
        self._app = app
        self._token = token.encode()
        self._hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}
        self._origins = {f"http://{host}" for host in self._hosts}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on a request, or refuse it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return

        async def sealed(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        refusal = self._refusal(scope)
        if refusal is None:
            await self._app(_within(scope), receive, sealed)
        else:
            await refusal(scope, receive, sealed)

    def _refusal(self, scope: Scope) -> PlainTextResponse | None:
        if scope["type"] != "http":
            return PlainTextResponse("not here", 404)
        headers = Headers(scope=scope)
        if headers.get("host") not in self._hosts:
            return PlainTextResponse("this is not the studio's address", 421)
        origins = headers.getlist("origin")
        if any(origin not in self._origins for origin in origins):
            return PlainTextResponse("not from the studio's page", 403)
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            return PlainTextResponse("not from the studio's page", 403)
        if not secrets.compare_digest(_token(scope), self._token):
            return PlainTextResponse("not here", 404)
        return None


def _token(scope: Scope) -> bytes:
    path: str = scope["path"]
    return path.split("/", 2)[1].encode() if path.startswith("/") else b""


def _within(scope: Scope) -> dict[str, Any]:
    """Take the token off the path."""
    token = "/" + scope["path"].split("/", 2)[1]
    path = scope["path"][len(token) :]
    return {**scope, "path": path, "raw_path": path.encode(), "root_path": ""}
