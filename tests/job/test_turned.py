"""A job on a round stock, from a model's file to the judgement of its programs."""

import re

import pytest
import trimesh

from relieffab.errors import FindingsError, InputError
from relieffab.job import run
from relieffab.job.certificate import check_certificate
from relieffab.job.load import gather
from relieffab.job.proof import judged_again
from relieffab.job.report import read_report

FLAGS = {
    "size": "30x20mm", "resolution": "60x40", "margin": "4mm", "depth": "1.2mm", "up": "z",
    "round": "24mm", "machine": "altmill-4x4-rotary", "finish": "ball-2", "lines": "ball-1",
}  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("turned")
    trimesh.creation.icosphere(2, 10.0).export(made / "ball.stl")
    settings = gather({**FLAGS, "model": str(made / "ball.stl")}, None, {})
    run.make(settings, made / "job")
    return made / "job"


def test_it_leaves_a_solid_and_programs_that_are_proved(folder):
    report = read_report(folder)
    assert report["panel"]["watertight"] and report["panel"]["max_error_mm"] <= 0.02
    assert report["picture"]["method"] == "orthographic"
    assert report["verification"]["ok"] and report["verification"]["gouge_mm"] <= 0.005
    assert report["slab"]["radius"] == 12.0
    assert report["machine"]["rotary"]["diameter"] == 150
    text = (folder / "02-finish.nc").read_text()
    assert "\nG93\n" in text and "round, 24 mm thick, 20 mm along X" in " ".join(text.split())
    assert "turns about X" in (folder / "report.html").read_text()


def test_it_is_judged_again_from_its_text(folder):
    assert run.verify_again(folder)["ok"]
    program = folder / "02-finish.nc"
    assert check_certificate(program) == []
    kept = program.read_text()
    program.write_text(re.sub(r"A(\d+)", lambda m: f"A{int(m[1]) + 3}", kept))
    try:
        assert not run.verify_again(folder)["ok"]
        with pytest.raises(FindingsError, match="does not carve the relief"):
            judged_again(program)
    finally:
        program.write_text(kept)


def test_its_solid_may_become_a_ring(folder):
    kept = read_report(folder)
    settings = gather({**kept["settings"], "bore": "16mm"}, None, {})
    report = run.add_panel(settings, folder)
    assert report["panel"]["volume_mm3"] < kept["panel"]["volume_mm3"] / 1.5
    assert (folder / "stock.step").exists() == (report["stock"]["file"] is not None)


def test_without_a_rotary_axis_nothing_is_begun(tmp_path):
    settings = gather({**FLAGS, "model": "ball.stl", "machine": "3018-prover"}, None, {})
    with pytest.raises(InputError, match="has no rotary axis"):
        run.make(settings, tmp_path / "job")
    assert not (tmp_path / "job").exists()
