import json

import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.job.show.lit import Lit
from relieffab.job.show.show import show

LIT = Lit()


def test_a_job_is_its_page_and_its_preview(job):
    shown = show(job, LIT)
    assert (shown.kind, shown.page) == ("job", job / "report.html")
    assert shown.facts["programs"] == ["01-rough.nc", "02-finish.nc", "03-lines.nc"]
    assert shown.facts["carves_the_relief"] is True
    assert any("careful guess" in note for note in shown.notes)
    assert shown.image.shape[2] == 3
    assert show(job / "report.json", LIT).facts == shown.facts


@pytest.mark.parametrize("name", ["relief.tiff", "relief.png"])
def test_a_relief_is_lit_and_measured(job, name):
    shown = show(job / name, LIT)
    assert shown.facts["size_mm"] == [40, 30]
    assert shown.facts["pixels"] == [80, 60]
    assert 0.9 < shown.facts["deepest_mm"] <= 1
    assert shown.image.shape == (60, 80, 3)


def test_light_and_texture_are_the_persons(job):
    images = [
        show(job / "relief.tiff", lit).image.astype(int)
        for lit in (LIT, Lit(135.0), Lit(texture="wood"))
    ]
    wall = images[0] - images[1]
    assert wall.min() < -20
    assert wall.max() > 20
    # Wood is redder than stone.
    assert np.ptp(images[2].mean(axis=(0, 1))) > np.ptp(images[0].mean(axis=(0, 1))) + 10


def test_layers_one_by_one_and_beside_each_other(job):
    assert show(job / "layers", LIT).image.shape == (60, 240)
    depth = show(job / "layers" / "depth.png", LIT)
    assert (depth.kind, depth.image.dtype) == ("picture", np.uint8)
    assert depth.image.max() == 255
    drawing = show(job / "layers" / "lines.svg", LIT)
    assert (drawing.kind, drawing.image) == ("page", None)


@pytest.mark.parametrize("axes", [(0, 1, 2), (1, 2, 0), (2, 0, 1)])
def test_a_solid_lies_on_its_broadest_side(tmp_path, axes):
    size = np.array([4.0, 3.0, 1.0])[list(axes)]
    path = tmp_path / "box.stl"
    trimesh.creation.box(size).export(path)
    shown = show(path, LIT)
    assert shown.facts["size"] == size.tolist()
    assert shown.facts["triangles"] == 12
    assert shown.image.std() > 5


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.stl", "hello", "no faces"),
        ("a.tiff", "hello", "cannot be read"),
        ("a.png", "hello", "cannot be read"),
        ("a.step", "hello", "not a STEP file"),
        ("a.nc", "hello", "error 2"),
        ("a.xyz", "hello", "nothing that can be shown"),
    ],
)
def test_bad_files_are_told_for_what_they_are(tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=words):
        show(tmp_path / name, LIT)


def test_what_is_not_there_or_does_not_fit(tmp_path, job):
    for path, words in ((tmp_path / "no", "no such file"), (tmp_path, "holds no job")):
        with pytest.raises(InputError, match=words):
            show(path, LIT)
    with pytest.raises(InputError, match="only programs"):
        show(job / "relief.tiff", LIT, cutter="flat-6")


def test_a_report_without_its_page_is_told(tmp_path, job):
    (tmp_path / "report.json").write_text((job / "report.json").read_text())
    with pytest.raises(InputError, match="page is missing"):
        show(tmp_path, LIT)
    report = json.loads((job / "report.json").read_text())
    assert report["settings"]["texture"] == "stone"
