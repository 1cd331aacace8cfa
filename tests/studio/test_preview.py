from dataclasses import replace

import numpy as np
import pytest

from relieffab.panel.blank import make_blank
from relieffab.progress import silent
from relieffab.relief.make import make_relief
from relieffab.stock import Stock
from relieffab.studio.preview import Preview, small
from relieffab.studio.worker import SupersededError

WIDTH = 128


def solve(preview, opened, job):
    return preview.relief(preview.view(opened, job, silent), job, silent)


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

    view = preview.view(opened, job(), cancel)
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
        panel = preview.panel(opened, job(corner="2mm", depth=depth), silent)
        assert panel.watertight
    assert len(drawn) == 1
    assert panel.vertices[:, 2].min() == -12.0
