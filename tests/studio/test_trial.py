import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.gcode.slab import Slab
from relieffab.progress import silent
from relieffab.studio.ask import Ask
from relieffab.studio.preview import Preview
from relieffab.studio.trial import Trial


@pytest.fixture(scope="module")
def tried(opened, job):
    preview = Preview(96)
    solved = preview.relief(preview.view(Ask(opened, job()), silent), job(), silent)
    trial = Trial()
    trial.carry_out(solved, job(), silent)
    return trial


def test_it_carves_the_relief(tried):
    last = tried.last
    assert [run.path.name for run in last.runs] == ["rough", "finish", "lines"]
    assert [run.file for run in last.runs] == ["01-rough.nc", "02-finish.nc", "03-lines.nc"]
    assert last.verdict.findings == ()
    assert last.verdict.gouge_mm < 0.005


def test_moments_of_the_programs_follow_each_other(tried):
    runs = tried.last.runs
    every = np.concatenate([run.ends for run in runs])
    assert (np.diff(every) >= 0).all()
    assert sum(run.seconds for run in runs) == pytest.approx(every[-1], rel=1e-3)


@pytest.mark.parametrize("share", [0.0, 0.013, 0.2, 0.5, 0.77, 0.999, 1.0, 2.0])
def test_the_stock_at_a_moment_is_what_the_moves_until_then_leave(tried, share):
    states = tried.last.states
    at = share * states.seconds
    slab, stock = tried.carved(at)
    slow = Slab.over(slab.grid, stock)
    for run in tried.last.runs:
        done = run.points[: np.searchsorted(run.ends, at, side="right")]
        if 0 < len(done) < len(run.points):
            start, end = run.ends[len(done) - 1], run.ends[len(done)]
            part = (at - start) / (end - start)
            done = np.vstack([done, done[-1] + part * (run.points[len(done)] - done[-1])])
        if len(done):
            slow.cut(done, run.path.cutter)
    np.testing.assert_allclose(slab.heights, slow.heights, atol=1e-5)


def test_before_the_first_move_the_stock_is_whole_and_after_the_last_it_is_carved(tried):
    assert (tried.carved(-1.0)[0].heights == 0).all()
    done = tried.carved(np.inf)[0].heights
    np.testing.assert_allclose(done, tried.last.verdict.carved, atol=1e-5)


def test_without_a_trial_there_is_nothing_to_see():
    with pytest.raises(InputError, match="no toolpaths yet"):
        Trial().carved(0.0)


def test_positions_are_tried_part_by_part(opened, job):
    long = job(size="400x40mm", margin="3mm", positions="index", resolution="96x72")
    preview = Preview(96)
    solved = preview.relief(preview.view(Ask(opened, long), silent), long, silent)
    last = Trial().carry_out(solved, long, silent)
    assert {run.file[0] for run in last.runs} <= {"1", "2"}
    assert all(run.placing for run in last.runs)


def test_marks_are_the_last_program(opened, job):
    styled = job(style="gouge", mark_spacing="2mm", mark_depth="0.3mm", mark_cutter="ball-3.175")
    preview = Preview(96)
    solved = preview.marked(preview.view(Ask(opened, styled), silent), styled, silent)
    last = Trial().carry_out(solved, styled, silent)
    assert [run.file for run in last.runs][-1] == "04-marks.nc"
    assert last.runs[-1].path.cutter.name == "ball-3.175"
    assert last.verdict.findings == ()
    carved, smooth = last.verdict.carved, solved.marks.smooth.heights
    marked = (smooth - solved.relief.heights) > 0.2
    assert (smooth - carved)[marked].mean() > 0.2


def test_programs_of_a_round_stock_are_not_shown(opened, job):
    column = job(round="20mm", machine="3018-prover-rotary", size="30x30mm")
    preview = Preview(96)
    solved = preview.relief(preview.view(Ask(opened, column), silent), column, silent)
    with pytest.raises(InputError, match="not shown here"):
        Trial().carry_out(solved, column, silent)
