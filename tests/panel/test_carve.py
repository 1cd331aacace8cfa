import manifold3d
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.errors import InputError, RelieffabError
from relieffab.grid import Grid
from relieffab.panel.carve import accept, largest_error, make_panel
from relieffab.panel.model import Panel
from relieffab.panel.solid import checked, is_watertight, panel_of
from relieffab.panel.weld import weld
from relieffab.relief.model import Relief
from relieffab.stock import Stock

HEIGHTS = st.one_of(st.just(0.0), st.sampled_from([-0.5, -1.0, -1e-5]), st.floats(-2, 0, width=16))


def space_below(relief):
    """Volume between the face and the relief: a prism a triangle."""
    h = relief.heights
    a, b, c, d = h[:-1, :-1], h[:-1, 1:], h[1:, :-1], h[1:, 1:]
    return -((a + c + d) / 6 + (a + b + d) / 6).sum() * relief.grid.pitch**2


def assert_solid(panel, stock):
    mesh = trimesh.Trimesh(panel.vertices, panel.faces, process=False)
    assert mesh.is_watertight
    assert mesh.is_volume
    assert mesh.volume == pytest.approx(panel.volume_mm3)
    low, high = mesh.bounds
    assert low.tolist() == [0, 0, -stock.thickness]
    assert high.tolist() == [stock.width, stock.height, 0]


def test_a_box_pit(make_relief):
    h = np.zeros((21, 31))
    h[5:16, 5:26] = -1.5
    stock = Stock(32, 22, 4)
    panel = make_panel(make_relief(h), stock)
    # A node below the face is a hexagonal pyramid of base 3 pixels: one pixel times its depth.
    assert panel.volume_mm3 == pytest.approx(32 * 22 * 4 - 11 * 21 * 1.5, rel=1e-9)
    assert panel.max_error_mm < 1e-9
    assert len(panel.faces) < 250
    assert_solid(panel, stock)


def test_bumps_grooves_and_walls(bumpy):
    stock = Stock(26, 20, 6)
    panel = make_panel(bumpy, stock, tolerance=0.01)
    whole = 26 * 20 * 6 - space_below(bumpy)
    assert abs(panel.volume_mm3 - whole) < 1e-3 * space_below(bumpy)
    assert 0 < panel.max_error_mm <= 0.01
    assert panel.watertight
    assert_solid(panel, stock)


def test_a_smaller_tolerance_takes_more_triangles(bumpy):
    stock = Stock(26, 20, 6)
    fine, coarse = (make_panel(bumpy, stock, tolerance=t) for t in (0.002, 0.1))
    assert fine.max_error_mm <= 0.002 < coarse.max_error_mm <= 0.1
    assert len(fine.faces) > 1.5 * len(coarse.faces)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(
    arrays(float, st.tuples(st.integers(2, 10), st.integers(2, 10)), elements=HEIGHTS),
    st.sampled_from([0.0, 0.01, 0.2, 0.9]),
    st.sampled_from([0.001, 0.05, 0.5]),
)
def test_any_relief_gives_a_volume_within_tolerance(heights, rim, tolerance):
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    grid = Grid(rows, cols, 0.3, (rim, rim + rows * 0.3))
    relief = Relief(grid, heights, np.ones((rows, cols), bool), 2.0)
    stock = Stock(cols * 0.3 + 2 * rim, rows * 0.3 + 2 * rim, 3.0)
    panel = make_panel(relief, stock, tolerance=tolerance)
    assert panel.watertight
    assert panel.max_error_mm <= tolerance
    mesh = trimesh.Trimesh(panel.vertices, panel.faces, process=False)
    assert mesh.is_volume
    area = stock.width * stock.height
    if rim in (0.0, 0.9):
        whole = 3.0 * area - space_below(relief)
        assert panel.volume_mm3 == pytest.approx(whole, abs=1.01 * tolerance * area)


def test_touching_pits_and_ridges_on_the_face_survive_single_precision(make_relief):
    rng = np.random.default_rng(5)
    stock = Stock(80, 60, 3)
    h = np.where(rng.random((30, 40)) < 0.3, np.round(-4 * rng.random((30, 40))) / 2, 0.0)
    panel = make_panel(make_relief(h, pitch=0.5, rim=8.0), stock)
    assert_solid(panel, stock)
    single = trimesh.Trimesh(*weld(panel.vertices, panel.faces), process=False)
    assert single.is_volume
    assert len(np.unique(single.vertices, axis=0)) == len(single.vertices)


@pytest.mark.parametrize("rim", [0.7, 12.3])
def test_noise_of_pits_leaves_the_face_flat_and_nothing_without_width(make_relief, rim):
    rng = np.random.default_rng(1)
    pitch = 1.8341589
    for _ in range(40):
        rows, cols = rng.integers(4, 14, 2)
        h = -(rng.random((rows + 1, cols + 1)) < 0.5).astype(float)
        size = np.array([cols, rows]) * pitch + 2 * rim * pitch
        panel = make_panel(make_relief(h, pitch, rim * pitch), Stock(*size, 3), tolerance=0.01)
        z = panel.vertices[:, 2]
        assert not ((z > -1e-7) & (z != 0)).any()
        single = trimesh.Trimesh(*weld(panel.vertices, panel.faces), process=False)
        assert single.is_volume


def test_nothing_below_the_face_leaves_the_slab(make_relief):
    stock = Stock(12, 10, 3)
    panel = make_panel(make_relief(np.zeros((5, 6))), stock)
    assert (len(panel.faces), panel.watertight, panel.max_error_mm) == (12, True, 0.0)
    assert panel.volume_mm3 == pytest.approx(360)
    assert_solid(panel, stock)


def test_a_cut_runs_out_of_the_side(make_relief):
    h = np.zeros((9, 13))
    h[3:6] = -1.0
    stock = Stock(12, 8, 3)
    panel = make_panel(make_relief(h, rim=0.0), stock)
    on_side = panel.vertices[np.isin(panel.vertices[:, 0], (0, 12))]
    assert {-3.0, -1.0, 0.0} == set(on_side[:, 2].round(9))
    assert panel.volume_mm3 == pytest.approx(12 * 8 * 3 - 12 * 3)


def test_a_cut_ends_in_a_wall_where_the_stock_goes_on(make_relief):
    stock = Stock(14, 10, 3)
    panel = make_panel(make_relief(np.full((9, 13), -1.0), rim=1.0), stock)
    assert panel.volume_mm3 == pytest.approx(14 * 10 * 3 - 12 * 8)
    assert_solid(panel, stock)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, 10.0, float("nan")])
def test_a_tolerance_that_is_none_is_refused(make_relief, tolerance):
    with pytest.raises(InputError, match="tolerance"):
        make_panel(make_relief(np.zeros((3, 3))), Stock(9, 9, 3), tolerance=tolerance)


def test_the_modeller_is_asked():
    points = np.eye(3)
    mesh = manifold3d.Mesh64(points, np.array([[0, 1, 2]], np.uint64))
    with pytest.raises(RelieffabError, match="NotManifold"):
        checked(manifold3d.Manifold(mesh), "an open triangle")
    with pytest.raises(RelieffabError, match="is empty"):
        checked(manifold3d.Manifold(), "nothing")


def test_a_result_out_of_tolerance_or_open_is_refused():
    box = trimesh.creation.box((1, 1, 1))
    vertices, faces = np.array(box.vertices), np.array(box.faces, np.int64)
    with pytest.raises(RelieffabError, match="out of tolerance"):
        accept(Panel(vertices, faces, True, 1.0, 0.03), 0.02)
    with pytest.raises(RelieffabError, match="not watertight"):
        accept(Panel(vertices, faces, False, 1.0, 0.01), 0.02)
    assert is_watertight(faces)
    assert not is_watertight(faces[1:])
    assert not is_watertight(np.concatenate([faces[1:], faces[1:2]]))


def test_the_error_is_measured_on_the_panel(bumpy):
    stock = Stock(26, 20, 6)
    panel = make_panel(bumpy, stock)
    pit = (panel.vertices[:, 2] < 0) & (panel.vertices[:, 2] > -6)
    lifted = panel.vertices + np.where(pit, 0.5, 0.0)[:, None] * [0, 0, 1]
    worst = largest_error(lifted, panel.faces, bumpy, stock)
    assert worst == pytest.approx(0.5, abs=0.02)


def test_rounding_next_to_the_face_is_taken_off():
    sunk = manifold3d.Manifold.cube((12, 10, 3)).translate((0, 0, -3 - 1e-12))
    assert panel_of(sunk, 0.0).vertices[:, 2].max() == 0.0


def test_progress_names_the_stages(bumpy):
    calls = []
    make_panel(bumpy, Stock(26, 20, 6), progress=lambda *step: calls.append(step))
    stages = [step[0] for step in calls]
    assert stages == sorted(stages, reverse=True)
    assert set(stages) == {"simplify", "carve"}
    assert calls[-1] == ("carve", 1, 1)
