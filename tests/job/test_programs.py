"""Programs of a panel longer than the machine: position after position, judged together."""

import json

import numpy as np
import pytest

from relieffab.errors import FindingsError, InputError
from relieffab.grid import Grid
from relieffab.job import milling, programs, proof, reliefs
from relieffab.job.certificate import certificate, check_certificate
from relieffab.job.folder import PROGRAMS
from relieffab.job.settings import default_job
from relieffab.job.sheet.page import page
from relieffab.relief.model import Relief
from relieffab.relief.store import read_relief

NAMES = [f"{k}-{name}.nc" for k in (1, 2) for name in ("01-rough", "02-finish")]
AIDS = [f"{k}-00-{name}.nc" for k in (1, 2) for name in ("outline", "probe")]


def wave(job):
    """A dish with ripples across the middle of a long panel."""
    grid = Grid.on_panel(job.size, job.resolution)
    x, y = np.meshgrid(*grid.node_axes())
    r = np.minimum(np.hypot((x - 135) / 25, (y - 10) / 7), 1.0)
    heights = -0.6 * (1 + np.cos(np.pi * r)) * (0.8 + 0.2 * np.sin(x))
    below = heights < -1e-3
    heights[~below] = 0.0
    return Relief(grid, heights, below[:-1, :-1] & below[1:, 1:], 1.5)


@pytest.fixture(scope="module", params=["index", "turn"])
def written(request, tmp_path_factory):
    """A job's folder with the programs of two positions, and its report."""
    folder = tmp_path_factory.mktemp(request.param)
    job = default_job(
        size="270x20mm", resolution="1080x80", depth="1.5mm", positions=request.param, plate="1mm"
    )
    facts = {"model": {"name": "wave"}, "settings": {"positions": request.param}, "schema": 1}
    facts["relief"] = {"sha256": reliefs.write_relief(wave(job), folder)}
    relief = read_relief(folder / "relief.tiff")
    planned = milling.plan_paths(relief, (), job)
    facts |= programs.write(planned, relief, job, facts, folder)
    verdict = proof.judge(relief, facts, folder)
    facts["verification"] = {
        **proof.verification_part(verdict, relief),
        "certificate": certificate(facts, folder),
    }
    facts = json.loads(json.dumps(facts))
    (folder / "report.json").write_text(json.dumps(facts))
    return folder, facts


def test_every_position_has_its_files(written):
    folder, facts = written
    assert [part["file"] for part in facts["programs"]] == NAMES
    assert [part["file"] for part in facts["aids"]] == AIDS
    stale = {path.name for name in PROGRAMS for path in folder.glob(name)}
    assert stale == {path.name for path in folder.glob("*.nc")} == {*NAMES, *AIDS}


def test_programs_say_how_the_stock_lies(written):
    folder, facts = written
    for part in facts["programs"]:
        text = (folder / part["file"]).read_text()
        place = part["position"]
        assert place["number"] == int(part["file"][0]) and place["count"] == 2
        assert f"(position: {place['number']} of 2, panel X" in text
        assert f"(placing: {part['placing']})" in text
        x, y = place["zero"]
        assert f"(work zero: X {x:g} Y {y:g} mm from the near left corner" in text
        (x0, *_), (x1, *_) = part["bounds_mm"]
        assert 0 <= x0 < x1 <= 138


def test_they_are_proved_together(written):
    _, facts = written
    verdict = facts["verification"]
    assert verdict["ok"] and verdict["gouge_mm"] <= 0.005
    (seam,) = verdict["seams"]
    assert seam["between"] == [1, 2] and seam["error_mm"] < 0.1
    assert sorted(verdict["certificate"]["programs"]) == NAMES


def test_the_certificate_holds_for_each_and_not_for_another_place(written):
    folder, facts = written
    for name in [*NAMES, *AIDS]:
        assert check_certificate(folder / name) == []
    moved = json.loads(json.dumps(facts))
    moved["programs"][3]["position"]["zero"][0] -= 0.5
    moved["verification"] = {}
    try:
        (folder / "report.json").write_text(json.dumps(moved))
        assert check_certificate(folder / NAMES[3]) is None
        with pytest.raises(FindingsError, match="gouges the relief"):
            proof.judged_again(folder / NAMES[3])
    finally:
        (folder / "report.json").write_text(json.dumps(facts))


def test_the_page_says_what_to_do(written):
    _, facts = written
    relief = {**facts["relief"], "file": "relief.tiff", "depth_mm": 2.0}
    shown = page({**facts, "version": "0", "relief": relief})
    for part in facts["programs"]:
        assert part["placing"] in shown and part["file"] in shown
    assert "Position 2 of 2: " in shown and "Seam of 1 and 2" in shown


def test_what_is_refused_before_any_work():
    with pytest.raises(InputError, match="--positions index or turn"):
        milling.check(default_job(size="300x90mm"))
    milling.check(default_job(size="300x90mm", positions="turn"))
    with pytest.raises(InputError, match="too large both ways"):
        milling.check(default_job(size="300x190mm", positions="index"))
    with pytest.raises(InputError, match="wider than the positions' overlap"):
        milling.check(default_job(size="300x90mm", positions="index", overlap="2mm"))
    assert milling.positions_of(default_job(positions="index")) == (None,)
