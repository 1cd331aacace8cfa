"""Every route, as the page uses it and as it might be misused."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from starlette.testclient import TestClient

from relieffab.studio import app as module
from relieffab.studio import upload
from relieffab.studio.app import make_app
from relieffab.studio.frames import unpack
from relieffab.studio.guard import POLICY, Guard
from relieffab.studio.worker import SupersededError


@pytest.fixture
def loaded(client, desk, opened):
    """A page with a model open."""
    desk.session.open(opened, up="y")
    return client


def frame(answer):
    assert answer.status_code == 200, answer.text
    return unpack(answer.content)


def fault(answer, status=422):
    assert answer.status_code == status, answer.text
    return answer.json()["error"]


def test_a_studio_begins_empty_and_says_what_may_be_chosen(client):
    state = client.get("state").json()
    assert state["model"] is None
    assert state["export"] is None
    assert state["settings"]["depth"] == "1.5mm"
    assert state["limit_bytes"] == upload.LARGEST
    assert {c["name"] for c in state["controls"]} == set(state["settings"])
    for route in ("preview", "panel", "toolpaths", "export"):
        assert "no model is open" in fault(client.post(route, json={}))["message"]
    for route in ("mesh", "job.toml"):
        assert "no model is open" in fault(client.get(route))["message"]


def test_a_model_comes_in_and_a_bad_one_leaves_it_there(client, ball, desk):
    with ball.open("rb") as data:
        state = client.post("model", params={"name": "ball.obj"}, content=data).json()
    assert (state["model"]["name"], state["model"]["triangles"]) == ("ball.obj", 5120)
    kept = list(desk.session.scratch.rglob("*.obj"))
    assert len(kept) == 1
    for name, body, words in (
        ("letter.stl", b"Dear Sir, here is my model.", "no faces"),
        ("empty.ply", b"", "empty"),
        ("letter.txt", b"Dear Sir", "not a model file"),
        ("", b"Dear Sir", "not a model file"),
    ):
        answer = client.post("model", params={"name": name}, content=body)
        assert words in fault(answer)["message"]
        assert client.get("state").json()["model"]["name"] == "ball.obj"
    assert list(desk.session.scratch.rglob("*.*")) == kept
    assert len(frame(client.get("mesh"))[1]["indices"]) == 5120


def test_uploads_are_limited_by_what_they_say_and_by_what_they_are(client, desk, monkeypatch):
    monkeypatch.setattr(upload, "LARGEST", 1 << 20)
    said = client.post("model", params={"name": "a.stl"}, headers={"content-length": str(2 << 30)})
    assert "too large" in fault(said)["message"]

    def endless():
        for _ in range(64):
            yield bytes(1 << 16)

    assert (
        "too large"
        in fault(client.post("model", params={"name": "a.stl"}, content=endless()))["message"]
    )
    assert list(desk.session.scratch.rglob("*.stl")) == []
    assert client.get("state").status_code == 200


def test_a_picture_comes_in_and_its_mask(client, bump, desk, tmp_path):
    state = client.post("model", params={"name": "bump.png"}, content=bump.read_bytes()).json()
    assert state["model"]["kind"] == "depth"
    assert state["model"]["about"] == "PNG, 120 x 90 pixels, 16 bits"
    assert "azimuth" in state["model"]["idle"]
    shown, arrays = frame(client.get("mesh"))
    assert shown["picture"] and shown["box"] == [-0.5, -0.5, 119.5, 89.5]
    assert arrays["colours"].shape == (90, 120, 4)
    whole, first = frame(client.post("preview", json={}))
    assert (whole["picture"]["kind"], whole["picture"]["mask"]) == ("depth", "even background")
    assert whole["worked_out"]["image"] == "depth" and "azimuth" in whole["idle"]
    assert first["heights"].min() >= -1.5

    half = np.zeros((90, 120), np.uint8)
    half[:, :60] = 255
    Image.fromarray(half).save(tmp_path / "bump.png")
    Image.fromarray(half[:, 30:]).save(tmp_path / "narrow.png")
    narrow = (tmp_path / "narrow.png").read_bytes()
    told = fault(client.post("mask", params={"name": "narrow.png"}, content=narrow))
    assert "does not fit" in told["message"] and "90 x 90" in told["found"]
    sent = (tmp_path / "bump.png").read_bytes()
    answer = client.post("mask", params={"name": "bump.png"}, content=sent).json()
    assert answer == {"mask": "bump-1.png"}
    assert len(list(desk.session.scratch.rglob("*.png"))) == 2
    masked, second = frame(client.post("preview", json={"settings": answer}))
    assert masked["picture"]["mask"] == "mask file"
    assert second["mask"].sum() != first["mask"].sum()
    assert 'mask = "bump-1.png"' in client.get("job.toml").text


def test_only_a_picture_has_a_mask(loaded, bump):
    told = fault(loaded.post("mask", params={"name": "m.png"}, content=bump.read_bytes()))
    assert "only a picture has a mask" in told["message"]


def test_the_scarab_stands_up(client, monkeypatch, model):
    monkeypatch.setattr("relieffab.subject.scarab", lambda: (model.vertices, model.faces))
    state = client.post("model", params={"name": "scarab"}).json()
    assert state["model"]["name"] == "scarab.obj"
    assert state["settings"]["up"] == "y"


def test_a_preview_shows_layers_lines_and_relief(loaded):
    header, arrays = frame(loaded.post("preview", json={"ask": 3, "settings": {"depth": "2mm"}}))
    rows, cols = arrays["mask"].shape
    assert (rows, cols) == (192, 256)
    assert arrays["heights"].shape == (rows + 1, cols + 1)
    assert arrays["heights"].min() >= -2.0 and arrays["heights"].max() == 0.0
    assert {arrays[name].shape for name in ("depth", "lambert", "lines")} == {(rows, cols)}
    assert arrays["lines"].max() == 255 and arrays["lines"].min() < 60  # dark on paper
    assert arrays["depth"][arrays["mask"] == 0].max() == 0
    points, starts = arrays["stroke_points"], arrays["stroke_starts"]
    assert points.shape[1] == 4 and starts[0] == 0 and starts[-1] == len(points)
    assert (points[:, :2] >= 0).all() and (points[:, :2] <= [40.0, 30.0]).all()
    assert (header["ask"], header["depth_mm"], header["size_mm"]) == (3, 2.0, [40.0, 30.0])
    assert header["pitch_mm"] == pytest.approx(40 / 256)
    assert np.array(header["matrix"]).shape == (4, 4)
    assert header["worked_out"]["line_depth"] == "0.125mm"
    assert set(header["seconds"]) == {"layers", "relief"}
    assert loaded.get("state").json()["settings"]["depth"] == "2mm"


def test_layers_alone_come_without_a_relief(loaded):
    header, arrays = frame(loaded.post("preview", json={"ask": 1, "want": ["layers"]}))
    assert "heights" not in arrays and "lines" in arrays
    assert "relief" not in header["seconds"]


def test_a_resting_hand_is_shown_more(loaded):
    _, arrays = frame(loaded.post("preview", json={"ask": 1, "fine": True, "want": ["layers"]}))
    assert arrays["mask"].shape == (384, 512)


def test_the_matrix_takes_the_mesh_to_the_panel(loaded):
    header, arrays = frame(loaded.post("preview", json={"want": ["layers"]}))
    positions = frame(loaded.get("mesh"))[1]["positions"]
    placed = positions @ np.array(header["matrix"])[:3, :3].T + np.array(header["matrix"])[:3, 3]
    assert placed[:, 2].max() == pytest.approx(0.0, abs=1e-4)
    assert placed[:, :2].min() == pytest.approx(3.0, abs=1e-3)  # the margin
    points = arrays["stroke_points"]
    assert (points[:, 2] <= 1e-3).all()


@pytest.mark.parametrize(
    ("settings", "setting", "words"),
    [
        ({"depth": "deep"}, "depth", "length"),
        ({"depth": "50mm"}, "depth", "through the stock"),
        ({"model": "/etc/passwd"}, None, "no such setting"),
        ({"elevation": 1}, "elevation", "not a text"),
    ],
)
def test_a_bad_setting_is_told_at_its_place(loaded, settings, setting, words):
    told = fault(loaded.post("preview", json={"settings": settings}))
    assert words in told["message"]
    assert told.get("setting") == setting
    assert frame(loaded.post("preview", json={"want": ["layers"]}))


@pytest.mark.parametrize("name", ["../machines/3018-prover", "/etc/passwd", "nonsense", ""])
def test_no_machine_is_read_from_elsewhere(loaded, name):
    told = fault(loaded.post("toolpaths", json={"settings": {"machine": name}}))
    assert told["message"] == f"no machine {name!r}"


@pytest.mark.parametrize("body", [b"[1]", b"{", b'"x"', b'{"settings": []}', b"\xff"])
def test_what_is_no_ask_is_refused(loaded, body):
    assert "ask" in fault(loaded.post("preview", content=body))["message"]


def test_an_ask_is_no_larger_than_it_need_be(loaded, monkeypatch):
    monkeypatch.setattr(module, "LARGEST_JSON", 100)
    assert "too large" in fault(loaded.post("preview", content=b" " * 1000))["message"]


def test_an_ask_that_comes_late_changes_nothing(loaded):
    frame(loaded.post("preview", json={"ask": 9, "page": "a", "settings": {"depth": "2mm"}}))
    late = loaded.post("preview", json={"ask": 8, "page": "a", "settings": {"depth": "1mm"}})
    assert (late.status_code, late.json()) == (409, {"superseded": True})
    assert loaded.get("state").json()["settings"]["depth"] == "2mm"
    # A page that was loaded anew counts from the beginning.
    frame(loaded.post("preview", json={"ask": 1, "page": "b", "settings": {"depth": "1mm"}}))


def test_of_many_asks_at_once_the_last_is_answered_and_stays(loaded, desk):
    def ask(n):
        settings = {"depth": f"{1 + n / 20:g}mm", "azimuth": f"{n}deg"}
        return loaded.post("preview", json={"ask": n, "page": "a", "settings": settings})

    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(ask, range(24)))
    assert {answer.status_code for answer in answers} <= {200, 409}
    header, _ = frame(answers[-1])
    assert (header["ask"], header["depth_mm"]) == (23, 2.15)
    assert desk.session.texts["azimuth"] == "23deg"


def test_a_model_opened_later_wins(desk, opened, monkeypatch, tmp_path):
    later = replace(opened, file=tmp_path / "later.obj")

    def parse(file, children):
        if file.name == "first.obj":
            desk.open(later.file)
        return later if file.name == "later.obj" else opened

    monkeypatch.setattr("relieffab.studio.upload.parse", parse)
    with pytest.raises(SupersededError):
        desk.open(tmp_path / "first.obj")
    assert desk.session.model is later


def test_warming_goes_step_by_step_and_lets_others_in_between(desk, monkeypatch):
    go, order = threading.Event(), []

    def first(progress):
        go.wait(10)
        order.append("first")

    steps = first, lambda progress: order.append("second")
    monkeypatch.setattr("relieffab.studio.warm.steps", lambda: steps)
    desk.warm()
    assert desk.state()["warming"]
    between = desk.worker.ask("preview", lambda progress: order.append("preview"))
    go.set()
    between.result(10)
    for _ in range(100):
        if not desk.state()["warming"]:
            break
        time.sleep(0.05)
    assert order == ["first", "preview", "second"]
    assert not desk.state()["warming"]


def test_warming_ends_at_a_fault(desk, monkeypatch):
    steps = (lambda progress: 1 / 0), lambda progress: None
    monkeypatch.setattr("relieffab.studio.warm.steps", lambda: steps)
    desk.warm()
    desk.worker.ask("panel", lambda progress: None).result(10)
    assert not desk.warming


def test_panel_toolpaths_and_moments(loaded):
    header, arrays = frame(loaded.post("panel", json={"ask": 1}))
    assert header["relief"] and header["thickness_mm"] == 12.0
    assert arrays["positions"][:, 2].min() == -12.0
    assert arrays["indices"].max() == len(arrays["positions"]) - 1
    assert "no toolpaths yet" in fault(loaded.get("carved", params={"at": 1}))["message"]
    header, arrays = frame(loaded.post("toolpaths", json={"ask": 2}))
    moves, kinds = arrays["moves"], arrays["kinds"]
    assert header["kinds"] == ["rapid", "rough", "finish", "lines", "marks"]
    assert set(kinds) == {0, 1, 2, 3}
    assert moves.shape == (len(kinds), 4) and len(arrays["program_of"]) == len(kinds)
    assert (np.diff(moves[:, 3]) >= 0).all()
    assert header["seconds_total"] == pytest.approx(moves[-1, 3], rel=1e-3)
    assert [p["name"] for p in header["programs"]] == ["rough", "finish", "lines"]
    assert sum(p["seconds"] for p in header["programs"]) == pytest.approx(
        header["seconds_total"], rel=1e-3
    )
    assert np.isnan(arrays["deviation"]).any() and np.isfinite(arrays["deviation"]).any()
    assert header["deviation_mm"]["gouge"] < 0.005
    for at, low in ((0, 0.0), (1e9, -1.5)):
        told, carved = frame(loaded.get("carved", params={"at": at}))
        assert told["size_mm"] == [40.0, 30.0]
        assert carved["heights"].shape == arrays["deviation"].shape
        assert carved["heights"].min() == pytest.approx(low, abs=0.05)
    for text in ("", "soon", "nan"):
        fault(loaded.get("carved", params={"at": text}))


def test_the_job_file_comes_as_a_file(loaded):
    answer = loaded.get("job.toml")
    assert answer.text.splitlines()[2] == 'model = "bumps.obj"'
    assert 'filename="job.toml"' in answer.headers["content-disposition"]


@pytest.mark.parametrize(
    "path",
    [
        "page/../app.py", "page/..%2fapp.py", "page/%2e%2e/app.py", "page//etc/passwd", "page/",
        "page/../../../pyproject.toml", "page/nothing.js", "result/",
        "result/%2e%2e/%2e%2e/etc/passwd", "result//etc/passwd", "nonsense",
    ],
)  # fmt: skip
def test_no_path_leads_out(loaded, path):
    answer = loaded.get(path)
    assert answer.status_code in (404, 422), path
    assert "import" not in answer.text and "root:" not in answer.text


def test_only_what_may_be_asked_may_be_asked(loaded):
    assert loaded.get("model").status_code == 405
    assert loaded.post("state").status_code == 405
    assert loaded.delete("state").status_code == 405


def test_every_answer_is_sealed(loaded):
    for answer in (loaded.get("state"), loaded.get("nonsense"), loaded.post("panel", content=b"[")):
        assert answer.headers["content-security-policy"] == POLICY
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
        assert answer.headers["cache-control"] == "no-store"


def test_a_report_is_shown_in_a_sandbox(loaded, desk, tmp_path):
    folder = tmp_path / "done"
    folder.mkdir()
    (folder / "report.html").write_text("<style>p{}</style>")
    (folder / "secret.txt").write_text("secret")
    desk.exporter.folder = folder
    desk.exporter.state = {"state": "done", "files": [{"name": "report.html", "bytes": 18}]}
    answer = loaded.get("result/report.html")
    assert answer.headers["content-security-policy"].startswith("sandbox;")
    assert "no such file" in fault(loaded.get("result/secret.txt"))["message"]


def test_cancelling_nothing_is_no_fault(loaded):
    assert loaded.post("cancel").json() == {"export": None}


def test_an_export_that_can_be_seen_to_fail_is_not_begun(loaded):
    told = fault(loaded.post("export", json={"settings": {"size": "4000x3000mm"}}))
    assert "larger than the machine" in told["message"]
    assert loaded.get("state").json()["export"] is None


def test_another_host_and_origin_are_refused_before_any_route(desk):
    guarded = Guard(make_app(desk), token="t", port=8765)
    with TestClient(guarded, base_url="http://evil.example/t") as stranger:
        assert stranger.get("state").status_code == 421
    with TestClient(guarded, base_url="http://127.0.0.1:8765/t") as page:
        evil = {"origin": "http://evil.example"}
        assert page.post("preview", json={}, headers=evil).status_code == 403
