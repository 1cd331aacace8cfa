"""A job with a style, from its settings to programs judged from their files."""

import json

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.job import composed, milling, reliefs, run, styles
from relieffab.job.drawn import read_strokes
from relieffab.job.load import gather
from relieffab.job.settings import default_job
from relieffab.job.stocks import machine_of, stock_of
from relieffab.layers.model import Layers
from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.store import read_relief
from relieffab.subject.shapes import sphere
from relieffab.template.model import make_template
from relieffab.template.svg import to_svg
from relieffab.toolpath.check import check

SETTINGS = {
    "size": "32x24mm",
    "resolution": "256x192",
    "margin": "5mm",
    "depth": "1.5mm",
    "up": "y",
    "style": "gouge",
    "ground": "pecked",
    "thickness": "8mm",
}


OTHER = {"style": "point", "ground": "plain", "size": "24x24mm", "resolution": "192x192"}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A sphere with a gouge's marks on a pecked ground: a folder, its settings and its report."""
    home = tmp_path_factory.mktemp("styled")
    vertices, faces = sphere(10.0, 2000)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices]
    lines += ["f " + " ".join(str(k + 1) for k in face) for face in faces]
    (home / "ball.obj").write_text("\n".join(lines))
    chosen = gather({**SETTINGS, "model": str(home / "ball.obj")}, None, {})
    run.make_relief(chosen, home / "out")
    report = run.add_toolpaths(chosen, home / "out")
    return home / "out", report


def test_the_report_tells_asked_and_measured(made):
    folder, report = made
    assert json.loads((folder / "report.json").read_text())["style"] == report["style"]
    part = report["style"]
    assert part["marks"] == "gouge" and part["cutter"]["name"] == "ball-2"
    for place in ("figure", "ground"):
        found = part["measured"][place]
        assert found["spacing_mm"] == pytest.approx(part["spacing_mm"], rel=0.1)
        assert found["depth_mm"] == pytest.approx(part["depth_mm"], rel=0.1)
        assert found["within_tolerance"] > 0.99 and found["left_p99_mm"] < 0.05
    assert report["relief"]["depth_mm"] == 1.5


def test_the_page_tells_them_too(made):
    folder, report = made
    shown = (folder / "report.html").read_text()
    found = report["style"]["measured"]["figure"]
    assert "<h2>Marks</h2>" in shown and f'<td class="n">{found["depth_mm"]:.2f}</td>' in shown
    assert (
        "On the ground" in shown
        and f"{report['style']['strokes']:,} strokes by <code>ball-2</code>" in shown
    )


def test_the_marks_have_a_program_of_their_own_and_all_of_it_is_proved(made):
    _, report = made
    assert [part["file"] for part in report["programs"]][-2:] == ["03-lines.nc", "04-marks.nc"]
    assert report["programs"][-1]["cutter"]["name"] == "ball-2"
    verdict = report["verification"]
    assert verdict["ok"] and verdict["gouge_mm"] <= 0.005
    assert verdict["within_tolerance"] > 0.96  # as without marks: the wall is steep


def test_without_the_marks_program_the_marks_are_missing(made):
    folder, report = made
    job = default_job(**SETTINGS)
    relief, (marks,) = read_relief(folder / "relief.tiff"), styles.read_marks(folder, report)
    ((_, paths),) = milling.plan_paths(relief, (), job, marks=[marks])
    tips = paths[-1].points[np.isfinite(paths[-1].feed)]
    assert paths[-1].name == "marks"
    # Its tip goes below the smooth relief by the marks' depth, and no deeper than the relief.
    depth = marks.smooth.height_at(*tips[:, :2].T) - tips[:, 2]
    assert np.percentile(depth, 99) == pytest.approx(0.13, abs=0.03)
    assert (tips[:, 2] > relief.height_at(*tips[:, :2].T) - 1e-6).all()


def test_a_template_shows_the_form_without_its_marks(made):
    folder, report = made
    job = default_job(**SETTINGS)
    run.add_template(gather(SETTINGS, None, {}), folder)
    smooth, strokes = styles.read_marks(folder, report)[0].smooth, read_strokes(folder)
    name = report["model"]["name"]
    wanted = make_template(smooth, strokes, stock_of(job), line_width=job.line_width, name=name)
    assert (folder / "template.svg").read_text() == to_svg(wanted)


def test_pecks_leave_room_for_every_cutter_beside_a_raised_frame():
    job = default_job(
        size="24x18mm", ground="pecked", frame="2mm", frame_height="1mm", rough="flat-2"
    )
    grid = Grid.on_panel(job.size, (240, 180))
    mask, none = np.zeros(grid.shape, bool), np.zeros(grid.shape)
    mask[80:100, 110:130] = True
    smooth = Relief(grid, np.where(nodes_of(mask), -1.0, 0.0), mask, 3.0)
    up = np.stack([none, none, none + 1], axis=2)
    layers = Layers(grid, none, up, mask, up[0, :1], none[None], none)
    relief, marks, part = styles.mark(smooth, layers, job)
    x, y = relief.grid.to_xy(*np.nonzero(relief.heights < -1e-6))
    # The widest of the cutters has a radius of 1.5875 mm, and the border is 2.5 mm wide.
    assert min(x.min(), y.min()) >= 2 + 2.5 - 2 * relief.grid.pitch
    check(relief, machine_of(job), milling.all_cutters_of(job), stock_of(job), 0.1)
    assert part["ground"] == "pecked" and len(marks.lines) > 20


def test_a_composed_panel_has_a_program_for_each_cutter_of_marks(made, tmp_path):
    """The sphere and another with a point's marks: what each was, on one panel, and proved."""
    folder, alone = made
    other = gather({**SETTINGS, **OTHER, "model": str(folder.parent / "ball.obj")}, None, {})
    run.make_relief(other, tmp_path / "point")
    places = [(folder, (24.0, 0.0)), (tmp_path / "point", (0.0, 0.0))]
    chosen = gather({"size": "56x24mm", "thickness": "8mm", "model": ""}, None, {})
    composed.make(chosen, places, tmp_path / "both")
    report = run.add_toolpaths(chosen, tmp_path / "both")
    programs = [(part["file"], part["cutter"]["name"]) for part in report["programs"]]
    assert programs[-2:] == [("04-marks.nc", "ball-2"), ("05-marks-2.nc", "vee-90")]
    verdict = report["verification"]
    assert verdict["ok"] and verdict["gouge_mm"] == 0 and verdict["within_tolerance"] > 0.96
    told = [[style["relief"] for style in part["styles"]] for part in report["reliefs"]]
    assert told == [["out"], ["point"]]
    assert "<b>point</b>" in (tmp_path / "both" / "report.html").read_text()
    ball, point = styles.read_marks(tmp_path / "both", report)
    (one,) = styles.read_marks(folder, alone)
    for line, own in zip(ball.lines, one.lines, strict=True):
        np.testing.assert_allclose(line - own, np.tile([24.0, 0.0], (len(own), 1)), atol=1e-3)
    assert point.cutter.name == "vee-90" and point.lines
    # The figure is the figure's: pecks on the ground are none of it.
    whole, part = (
        read_relief(tmp_path / "both" / "relief.tiff"),
        read_relief(folder / "relief.tiff"),
    )
    other = read_relief(tmp_path / "point" / "relief.tiff")
    assert whole.mask.sum() == part.mask.sum() + other.mask.sum()


def test_marks_come_back_from_their_files(made, tmp_path):
    folder, report = made
    job = default_job(**SETTINGS)
    (marks,) = styles.read_marks(folder, report)
    assert marks.cutter.name == "ball-2"
    assert len(marks.lines) == report["style"]["strokes"]
    relief = read_relief(folder / "relief.tiff")
    assert (relief.heights <= marks.smooth.heights + 1e-6).all()
    (tmp_path / "layers").mkdir()
    styles.write_marks([marks], job, tmp_path)
    (again,) = styles.read_marks(tmp_path, report)
    for one, other in zip(marks.lines, again.lines, strict=True):
        assert np.array_equal(one, other)
    assert styles.read_marks(tmp_path, {}) == ()


def test_a_job_without_a_style_is_as_it_was():
    plain, styled = default_job(), default_job(style="gouge")
    assert styles.style_of(plain).plain
    assert reliefs.carving_of(plain).depth == 3.0
    assert reliefs.carving_of(styled).depth == 3.0 - styles.style_of(styled).headroom
    assert milling.all_cutters_of(plain) == milling.cutters_of(plain)
    assert [c.name for c in milling.all_cutters_of(styled)][3:] == ["ball-2"]


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"mark_depth": "1mm"}, "too much of the relief's depth"),
        ({"mark_depth": "2mm"}, "too much of the relief's depth"),
        ({"mark_spacing": "0.01mm"}, "closer together"),
        ({"mark_depth": "0.01mm"}, "finer than the relief's pixels"),
        ({"mark_cutter": "ball-9"}, "ball-9"),
        ({"mark_cutter": "vee-90", "depth": "7mm"}, "vee-90 is too short"),
    ],
)
def test_what_cannot_be_marked_is_refused_before_any_work(wrong, says):
    with pytest.raises(InputError, match=says):
        milling.check(default_job(**{**SETTINGS, **wrong}))


@pytest.mark.parametrize(
    ("setting", "text"), [("style", "gauge"), ("ground", "rough"), ("mark_direction", "across")]
)
def test_words_that_are_no_style(setting, text):
    with pytest.raises(InputError, match=setting):
        default_job(**{setting: text})
    assert default_job(mark_direction="form").mark_direction is None
    assert default_job(mark_direction="30deg").mark_direction == 30.0
