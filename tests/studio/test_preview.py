from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.job import styles
from relieffab.job.seen import look_at
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.read import read_picture
from relieffab.panel.blank import make_blank
from relieffab.progress import silent
from relieffab.relief.make import make_relief
from relieffab.stock import Stock
from relieffab.studio.ask import Ask
from relieffab.studio.preview import Preview, small, wide_enough
from relieffab.studio.sheet import sheet_of_picture
from relieffab.studio.worker import SupersededError

WIDTH = 128


def solve(preview, opened, job):
    return preview.relief(preview.view(Ask(opened, job), silent), job, silent)


@pytest.fixture
def preview():
    return Preview(WIDTH)


def test_the_longer_side_has_the_pages_width(job):
    assert small(job(size="120x90mm"), 256).resolution == (256, 192)
    assert small(job(size="50x100mm"), 256).resolution == (128, 256)


@pytest.mark.parametrize(
    "typed",
    [{"depth": "3mm"}, {"form_length": "3mm"}, {"line_depth": "0.3mm"}, {"line_width": "1mm"},
     {"line_detail": "3mm"}, {"wall_angle": "60deg"}, {"carve": "surface"}],
)  # fmt: skip
def test_a_warm_start_comes_to_the_relief_that_a_cold_one_comes_to(preview, opened, job, typed):
    solve(preview, opened, job())
    warm = solve(preview, opened, job(**typed))
    cold, _ = make_relief(warm.view.layers, warm.carving)
    assert warm.solution.converged
    error = np.abs(warm.relief.heights - cold.heights)
    assert np.sqrt((error**2).mean()) < 0.004 * warm.relief.depth


def test_a_picture_is_seen_as_its_job_sees_it(preview, picture, bump, job):
    solved = solve(preview, picture, job(up="", depth="1.4mm"))
    shallow = solve(preview, picture, job(up="", depth="1mm"))
    assert shallow.view is solved.view
    assert (solved.view.kind, solved.view.facts["kind_by"]) == ("depth", "values")
    tiny = replace(small(job(up="", depth="1mm"), WIDTH), model=str(bump))
    seen = look_at(read_picture(bump), tiny)
    np.testing.assert_array_equal(shallow.view.layers.depth, seen.layers.depth)
    np.testing.assert_array_equal(shallow.view.layers.lines, seen.layers.lines)
    cold, _ = make_relief(seen.layers, shallow.carving)
    error = np.abs(shallow.relief.heights - cold.heights)
    assert np.sqrt((error**2).mean()) < 0.004


def test_of_a_drawing_only_lines_are_carved(preview, job):
    ink = np.ones((60, 80, 1))
    ink[28:32, 10:70] = 0.0
    scrawl = sheet_of_picture(Picture(ink, None, 8, "PNG", "a.png"), Path("a.png"))
    solved = solve(preview, scrawl, job(line_depth="0.4mm"))
    assert (solved.view.kind, solved.view.carve) == ("drawing", "lines")
    assert solved.relief.heights.min() == pytest.approx(-0.4, abs=0.05)
    bolder = solve(preview, scrawl, job(line_depth="0.4mm", line_spread="0.5mm"))
    assert bolder.view.layers.lines.sum() > 1.2 * solved.view.layers.lines.sum()
    with pytest.raises(InputError, match="no surface"):
        solve(preview, scrawl, job(carve="surface"))


STYLED = {"style": "gouge", "mark_spacing": "1.5mm", "mark_depth": "0.3mm", "ground": "pecked"}


def test_marks_are_those_of_the_job(preview, opened, job):
    ask = Ask(opened, job(**STYLED, resolution="128x96"))
    view = preview.view(ask, silent)
    bare = preview.relief(view, ask.job, silent)
    assert bare.marks is None and bare.relief.depth == pytest.approx(1.2)
    marked = preview.marked(view, ask.job, silent)
    assert preview.marked(view, ask.job, silent) is marked
    relief, marks = styles.carve(bare.relief, view.layers, ask.job)
    np.testing.assert_array_equal(marked.relief.heights, relief.heights)
    assert marked.relief.depth == 1.5
    assert len(marked.marks.lines) == len(marks.lines) > 10
    other = preview.marked(view, job(**{**STYLED, "mark_direction": "45deg"}), silent)
    assert other is not marked
    plain = preview.relief(preview.view(Ask(opened, job()), silent), job(), silent)
    assert preview.marked(plain.view, job(), silent) is plain


def test_marks_are_seen_in_pixels_enough(job):
    assert wide_enough(job(), 128) == 128
    fine = job(**STYLED, resolution="800x600")
    width = wide_enough(fine, 64)
    style = styles.style_of(fine)
    style.check(fine.depth, 40 / width)
    assert width == 85  # three to the narrower of spacing and mark, here 2 sqrt(2 r d - d^2)
    assert wide_enough(fine, 512) == 512
    assert wide_enough(job(**STYLED, resolution="80x60"), 64) == 80  # as many as the job has


def test_what_does_not_change_is_kept(preview, opened, job):
    first = solve(preview, opened, job())
    assert solve(preview, opened, job()) is first
    deeper = solve(preview, opened, job(depth="2mm"))
    assert deeper.view is first.view and deeper is not first
    bolder = solve(preview, opened, job(line_width="1mm"))
    assert bolder.view.sight is first.view.sight
    assert bolder.view.layers.strokes is first.view.layers.strokes
    assert bolder.view.layers.lines.sum() > 1.2 * first.view.layers.lines.sum()
    turned = solve(preview, opened, job(azimuth="40deg"))
    assert turned.view.sight is not first.view.sight


def test_programs_and_names_make_no_difference(preview, opened, job):
    first = solve(preview, opened, job())
    other = job(machine="shapeoko-3", material="hardwood", scallop="0.02mm")
    assert solve(preview, opened, other) is first


def test_another_model_is_seen_anew(preview, opened, job, model):
    first = solve(preview, opened, job())
    flatter = replace(model, vertices=model.vertices * [1.0, 0.6, 1.0])
    other = replace(opened, shown=flatter, tried=flatter)
    second = solve(preview, other, job())
    assert second.view.layers.mask.sum() < 0.9 * first.view.layers.mask.sum()


def test_it_is_cancelled_between_stages_and_goes_on_from_what_was_done(preview, opened, job):
    def cancel(stage, done, total, unit=""):
        if stage == "relief":
            raise SupersededError

    view = preview.view(Ask(opened, job()), cancel)
    with pytest.raises(SupersededError):
        preview.relief(view, job(), cancel)
    assert solve(preview, opened, job()).view is view


def test_a_stock_with_a_shape_is_drawn_once(preview, opened, job, monkeypatch):
    drawn = []

    def blank(stock):
        drawn.append(stock)
        return make_blank(Stock(stock.width, stock.height, stock.thickness))

    monkeypatch.setattr("relieffab.studio.preview._blank", blank)
    for depth in ("1.5mm", "1.6mm"):
        panel = preview.panel(Ask(opened, job(corner="2mm", depth=depth)), silent)
        assert panel.watertight
    assert len(drawn) == 1
    assert panel.vertices[:, 2].min() == -12.0


def test_a_round_stock_is_seen_bent(preview, opened, job):
    panel = preview.panel(Ask(opened, job(round="20mm", bore="8mm")), silent)
    assert panel.watertight
    np.testing.assert_allclose(panel.vertices.max(axis=0), [20.0, 30.0, 0.0], atol=0.02)
    np.testing.assert_allclose(panel.vertices.min(axis=0), [0.0, 0.0, -20.0], atol=0.02)
