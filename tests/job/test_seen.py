import json

import numpy as np
import pytest
from PIL import Image

from relieffab.errors import InputError
from relieffab.job.run import make_layers, make_relief
from relieffab.job.seen import look_at, read_model
from relieffab.job.settings import default_job, resolve
from relieffab.relief.store import read_relief

SMALL = {"resolution": "160x120", "size": "40x30mm", "margin": "3mm"}


@pytest.fixture
def ball(tmp_path):
    """A ball's depth map of 8 bits."""
    i, j = np.indices((200, 240)) - np.array([99.5, 119.5])[:, None, None]
    height = np.sqrt(np.maximum(90.0**2 - i**2 - j**2, 0.0)) / 90.0
    grey = np.where(i**2 + j**2 < 90**2, 20 + 235 * height, 0)
    Image.fromarray(np.rint(grey).astype(np.uint8)).save(tmp_path / "ball.png")
    return tmp_path / "ball.png"


@pytest.fixture
def scrawl(tmp_path):
    i, j = np.indices((120, 160))
    ink = (np.abs(i - 60) < 2) & (np.abs(j - 80) < 60)
    Image.fromarray(np.where(ink, 0, 255).astype(np.uint8)).save(tmp_path / "scrawl.png")
    return tmp_path / "scrawl.png"


@pytest.fixture
def ring(tmp_path):
    path = tmp_path / "ring.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">'
        '<circle cx="20" cy="15" r="9" fill="none" stroke="black" stroke-width="0.8"/></svg>'
    )
    return path


def test_the_report_tells_of_a_depth_map(ball, tmp_path):
    chosen = resolve([("test", {**SMALL, "model": str(ball), "image": "depth"})])
    report = make_relief(chosen, tmp_path / "out")
    kept = json.loads((tmp_path / "out" / "report.json").read_text())
    assert kept["model"] == report["model"]
    model = report["model"]
    assert (model["kind"], model["width"], model["height"], model["bits"]) == ("depth", 240, 200, 8)
    assert model["mask"] == "even background"
    assert (model["near"], model["near_by"]) == ("white", "background")
    assert model["banding"]["moved_steps"] <= 0.5 + 1e-9
    assert model["banding"]["flat_share"] > 4 * model["banding"]["flat_share_after"]
    assert len(model["sha256"]) == 64
    relief = read_relief(tmp_path / "out" / "relief.tiff")
    assert len(np.unique(np.round(relief.heights, 5))) > 2000


def test_the_report_tells_of_a_depth_map_beside_a_normal_map(ball, tmp_path):
    i, j = np.indices((200, 240)) - np.array([99.5, 119.5])[:, None, None]
    up = np.sqrt(np.maximum(90.0**2 - i**2 - j**2, 0.0))
    normals = np.where(up[..., None] > 0, np.stack([j, -i, up], axis=-1) / 90.0, [0, 0, 1.0])
    normals = np.rint(127.5 * normals + 127.5).astype(np.uint8)
    Image.fromarray(normals).save(tmp_path / "normals.png")
    told = {**SMALL, "model": str(tmp_path / "normals.png"), "depth_map": str(ball)}
    model = make_relief(resolve([("test", told)]), tmp_path / "out")["model"]
    assert model["kind"] == "normal"
    assert (model["depth_map"]["file"], model["depth_map"]["near"]) == ("ball.png", "white")
    assert model["depth_mm"] == pytest.approx(12.0, rel=0.1)  # a ball as high as the room


def test_a_drawing_and_an_svg_of_strokes_are_lines_only(scrawl, ring, tmp_path):
    for path in (scrawl, ring):
        chosen = resolve([("test", {**SMALL, "model": str(path), "line_depth": "0.4mm"})])
        make_relief(chosen, tmp_path / path.stem)
        relief = read_relief(tmp_path / path.stem / "relief.tiff")
        assert relief.heights.min() == pytest.approx(-0.4, abs=0.05)
        with pytest.raises(InputError, match="no surface"):
            make_relief(
                resolve([("test", {**SMALL, "model": str(path), "carve": "surface"})]),
                tmp_path / "never",
            )
    assert not (tmp_path / "never").exists()


def test_strokes_of_an_svg_come_through_where_they_are(ring, tmp_path):
    make_layers(resolve([("test", {**SMALL, "model": str(ring)})]), tmp_path / "out")
    job = default_job(**SMALL, model=str(ring))
    seen = look_at(read_model(job), job)
    (stroke,) = seen.layers.strokes
    np.testing.assert_allclose(np.hypot(*(stroke.points - [20, 15]).T), 9.0, atol=0.02)
    again = default_job(**SMALL, model=str(tmp_path / "out" / "layers" / "lines.svg"))
    (back,) = look_at(read_model(again), again).layers.strokes
    assert back.closed
    np.testing.assert_allclose(np.hypot(*(back.points - [20, 15]).T), 9.0, atol=0.02)


@pytest.mark.parametrize(
    "wrong",
    [{"view": "left"}, {"azimuth": "30deg"}, {"perspective": "30deg"}, {"text": "a"}, {"up": "y"}],
)
def test_settings_of_other_kinds_of_model_are_refused(ball, wrong):
    job = default_job(**SMALL, model=str(ball), **wrong)
    with pytest.raises(InputError, match="says nothing of a model of this kind") as fault:
        read_model(job)
    assert f"--{next(iter(wrong))}" in str(fault.value)


def test_settings_of_pictures_mean_nothing_to_others(ring, tmp_path):
    (tmp_path / "a.ttf").write_bytes(b"\0\1\0\0")
    (tmp_path / "a.obj").write_text("v 0 0 0")
    for name in ("ring.svg", "a.ttf", "a.obj"):
        with pytest.raises(InputError, match="--image"):
            read_model(default_job(model=str(tmp_path / name), image="photo"))
    with pytest.raises(InputError, match="--text"):
        read_model(default_job(model=str(tmp_path / "a.ttf")))


def test_a_figure_beyond_the_panel_s_clear_edge_is_refused(ring):
    job = default_job(**{**SMALL, "size": "18.5x18.5mm", "margin": "0mm"}, model=str(ring))
    with pytest.raises(InputError):
        look_at(read_model(job), job)
