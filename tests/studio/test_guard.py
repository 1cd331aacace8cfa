import pytest
from anyio.from_thread import start_blocking_portal

from relieffab.studio.guard import HEADERS, Guard, new_token

TOKEN, PORT = "a-token-nobody-guesses", 8765
HOST = f"127.0.0.1:{PORT}"


def answer(path, headers=(), kind="http"):
    """Status, headers, and the path that came through the guard, if it did."""
    seen, sent = [], []

    async def app(scope, receive, send):
        seen.append(scope["path"])
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"in"})

    async def send(message):
        sent.append(message)

    async def receive():
        return {"type": "http.request", "body": b""}

    raw = [(name.encode(), value.encode()) for name, value in headers]
    scope = {"type": kind, "path": path, "headers": raw, "method": "GET", "query_string": b""}
    with start_blocking_portal() as portal:  # a browser's driver may hold this thread's loop
        portal.call(Guard(app, token=TOKEN, port=PORT), scope, receive, send)
    told = {name.decode().lower(): value.decode() for name, value in sent[0]["headers"]}
    return sent[0]["status"], told, seen


def test_the_page_comes_in_and_the_token_stays_outside():
    for host in (HOST, f"localhost:{PORT}"):
        status, _, seen = answer(f"/{TOKEN}/state", [("host", host)])
        assert (status, seen) == (200, ["/state"])
    own = [("host", HOST), ("origin", f"http://{HOST}"), ("sec-fetch-site", "same-origin")]
    assert answer(f"/{TOKEN}/", own)[0] == 200


@pytest.mark.parametrize(
    "host",
    ["evil.example", f"evil.example:{PORT}", "127.0.0.1", "127.0.0.1:80", "", HOST + ".evil"],
)
def test_another_host_is_refused(host):
    status, _, seen = answer(f"/{TOKEN}/state", [("host", host)])
    assert (status, seen) == (421, [])


def test_no_host_is_refused():
    assert answer(f"/{TOKEN}/state")[0] == 421


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", f"https://{HOST}", "http://127.0.0.1:1", ""]
)
def test_another_origin_is_refused(origin):
    headers = [("host", HOST), ("origin", origin)]
    status, _, seen = answer(f"/{TOKEN}/state", headers)
    assert (status, seen) == (403, [])


def test_a_second_origin_does_not_slip_past_the_first():
    headers = [("host", HOST), ("origin", f"http://{HOST}"), ("origin", "http://evil.example")]
    assert answer(f"/{TOKEN}/state", headers)[0] == 403


def test_what_a_browser_calls_foreign_is_refused():
    for site in ("cross-site", "same-site"):
        status, _, seen = answer(f"/{TOKEN}/state", [("host", HOST), ("sec-fetch-site", site)])
        assert (status, seen) == (403, [])


@pytest.mark.parametrize(
    "path", ["/", "", "/state", f"/{TOKEN}x/state", f"/{TOKEN[:-1]}/state", f"//{TOKEN}/", "/ä/"]
)
def test_without_the_token_nothing_is_here(path):
    status, _, seen = answer(path, [("host", HOST)])
    assert (status, seen) == (404, [])


def test_the_token_is_compared_in_constant_time(monkeypatch):
    compared = []

    def compare(one, other):
        compared.append((one, other))
        return True

    monkeypatch.setattr("relieffab.studio.guard.secrets.compare_digest", compare)
    answer("/guess/state", [("host", HOST)])
    assert compared == [(b"guess", TOKEN.encode())]


def test_no_socket_of_another_kind_comes_in():
    assert answer(f"/{TOKEN}/", [("host", HOST)], kind="websocket")[2] == []


def test_every_answer_is_sealed():
    for path in (f"/{TOKEN}/state", "/nothing"):
        _, told, _ = answer(path, [("host", HOST)])
        assert {name.lower(): value for name, value in HEADERS.items()}.items() <= told.items()
    policy = HEADERS["Content-Security-Policy"]
    assert "default-src 'self'" in policy and "frame-ancestors 'none'" in policy
    assert "unsafe" not in policy


def test_tokens_are_long_and_new():
    tokens = {new_token() for _ in range(100)}
    assert len(tokens) == 100
    assert min(map(len, tokens)) >= 32
