"""A small relief planned whole, and carved again by plain sampling."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import maximum_filter

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief
from relieffab.relief.style.model import Marks
from relieffab.stock import Stock
from relieffab.toolpath.plan import default_cutters, plan
from relieffab.toolpath.positions import Position, positions
from relieffab.toolpath.remains import after
from relieffab.toolpath.settings import Settings

GRID = Grid.on_panel((30.0, 24.0), (250, 200))
DEPTH = 2.0


def figure():
    """An oval with a wall of 1.5 mm, soft hills and two grooves."""
    x, y = np.meshgrid(*GRID.node_axes())
    inside = np.hypot((x - 15) / 11, (y - 12) / 8) < 1
    heights = -1.4 + 0.3 * np.sin(x / 1.7) * np.cos(y / 1.3)
    grooves = np.minimum(np.abs(y - 12 - np.sin(x)), np.abs(x - 15 + np.sin(y)))
    heights = heights - np.clip(0.6 - 1.2 * grooves, 0.0, 0.4)
    heights = np.where(inside, np.clip(heights, -DEPTH, 0.0), 0.0)
    return Relief(GRID, heights, inside[:-1, :-1] | inside[1:, 1:], DEPTH)


def strokes():
    t = np.linspace(6, 24, 300)
    points = np.column_stack([t, 12 + np.sin(t)])
    return (Stroke(points, "crease", np.ones(len(t))),)


@pytest.fixture(scope="module")
def planned():
    relief = figure()
    machine, material = profiles.machine("3018-prover"), profiles.material("softwood")
    return relief, plan(relief, strokes(), machine, material)


def carved(relief, paths, spacing=0.02):
    left = np.zeros(GRID.node_shape)
    for path in paths:
        steps = np.diff(path.points, axis=0)
        parts = np.maximum(np.ceil(np.linalg.norm(steps, axis=1) / spacing), 1).astype(int)
        which = np.repeat(np.arange(len(steps)), parts)
        share = 1 - (np.repeat(np.cumsum(parts), parts) - np.arange(len(which)) - 1) / parts[which]
        at = path.points[which] + steps[which] * share[:, None]
        left = after(left, GRID, path.cutter, at)
    return left


def test_there_is_one_path_a_cutter_in_order(planned):
    _, paths = planned
    assert [path.name for path in paths] == ["rough", "finish", "lines"]
    assert [path.cutter.name for path in paths] == [
        "flat-3.175",
        "tapered-ball-1",
        "tapered-ball-0.5",
    ]


def test_nothing_is_gouged_and_the_figure_is_reached(planned):
    relief, paths = planned
    excess = carved(relief, paths) - relief.heights
    assert excess.min() > -0.005
    figure = relief.heights < 0
    assert (excess[figure] < 0.1).mean() > 0.95


def test_no_move_goes_below_the_depth_and_no_rapid_below_the_face(planned):
    for path in planned[1]:
        assert path.points[:, 2].min() >= -DEPTH
        assert path.points[np.isinf(path.feed), 2].min() > 0
        assert np.isinf(path.feed[[0, -1]]).all()
        assert path.points[-1, 2] == 5.0


def test_roughing_leaves_its_allowance(planned):
    relief, paths = planned
    excess = carved(relief, paths[:1]) - relief.heights
    assert excess[relief.heights < -0.5].min() > 0.28


def test_planning_again_gives_the_same_paths(planned):
    relief, paths = planned
    again = plan(relief, strokes(), profiles.machine(), profiles.material())
    for one, other in zip(paths, again, strict=True):
        assert np.array_equal(one.points, other.points)
        assert np.array_equal(one.feed, other.feed)


def test_a_finer_stepover_leaves_less(planned):
    relief, paths = planned
    machine, material = profiles.machine(), profiles.material()
    coarse = plan(relief, (), machine, material, settings=Settings(stepover=0.6))
    figure = relief.heights < 0
    left = [(carved(relief, path[:2]) - relief.heights)[figure].mean() for path in (paths, coarse)]
    assert left[0] < 0.8 * left[1]


def test_planning_is_cancelled_within_a_cutters_work():
    told = []

    def cancel(stage, done, total, unit=""):
        told.append(done)
        if told.count(1) == 2:
            raise KeyboardInterrupt

    machine, material = profiles.machine("3018-prover"), profiles.material("softwood")
    with pytest.raises(KeyboardInterrupt):
        plan(figure(), strokes(), machine, material, progress=cancel)
    assert told[-2:] == [1, 1]


def test_a_relief_too_shallow_for_any_cut_is_refused():
    heights = np.zeros(GRID.node_shape)
    heights[50:60, 50:60] = -0.005
    relief = Relief(GRID, heights, np.ones(GRID.shape, bool), 1.0)
    with pytest.raises(InputError, match="nothing to cut"):
        plan(relief, (), profiles.machine(), profiles.material())


def test_stock_is_checked():
    with pytest.raises(InputError, match="through the stock"):
        plan(figure(), (), profiles.machine(), profiles.material(), stock=Stock(30.0, 24.0, 1.5))


@pytest.mark.parametrize("milling", ["climb", "conventional"])
def test_rows_cut_one_way_keep_the_stock_on_one_side(milling):
    relief = figure()
    settings = Settings(stepover=0.4, milling=milling)
    paths = plan(relief, (), profiles.machine(), profiles.material(), settings=settings)
    finish = paths[1]
    steps = np.diff(finish.points, axis=0)[np.isfinite(finish.feed[1:])]
    ways = steps[np.abs(steps[:, 1]) < 1e-9, 0]
    along = ways[ways > 0].sum() / np.abs(ways).sum()
    # Rows go from the far edge to the near one, with what is to be cut on the near side.
    assert along > 0.9 if milling == "climb" else along < 0.1


def test_rows_may_go_at_an_angle_and_across_themselves():
    relief = figure()
    settings = Settings(stepover=0.4, angle=30.0, crossed=True)
    paths = plan(relief, (), profiles.machine(), profiles.material(), settings=settings)
    steps = np.diff(paths[1].points, axis=0)[np.isfinite(paths[1].feed[1:])]
    steps = steps[np.hypot(steps[:, 0], steps[:, 1]) > 0.5]
    angles = np.degrees(np.arctan2(steps[:, 1], steps[:, 0])) % 180
    assert (np.abs(angles - 30) < 1).mean() > 0.4
    assert (carved(relief, paths) - relief.heights).min() > -0.005


def test_the_finest_cutter_visits_only_what_the_one_before_could_not_reach(planned):
    relief, _ = planned
    paths = plan(relief, (), profiles.machine(), profiles.material())
    before = carved(relief, paths[:2]) - relief.heights
    tips = paths[2].points[np.isfinite(paths[2].feed)]
    row, col = GRID.to_index(tips[:, 0], tips[:, 1])
    reach = 0.6 / GRID.pitch
    near = maximum_filter(before, size=2 * round(reach) + 1)
    low = tips[:, 2] < -0.05
    seen = near[np.rint(row[low]).astype(int), np.rint(col[low]).astype(int)]
    assert (seen > 0.03).mean() > 0.95
    assert paths[2].cutting_length < 0.5 * paths[1].cutting_length


@pytest.mark.parametrize("way", ["index", "turn"])
def test_positions_leave_what_one_does(planned, way):
    relief, paths = planned
    machine = replace(profiles.machine(), travel=(20.0, 157.0, 34.0))
    cutters, stock = default_cutters(), Stock(30.0, 24.0, 8.0)
    places = positions(stock, machine, cutters, way, overlap=4.0)
    assert len(places) == 2
    parts = []
    for place in places:
        found = plan(relief, strokes(), machine, profiles.material(), stock=stock, position=place)
        assert [path.name for path in found] == ["rough", "finish", "lines"]
        for path in found:
            assert (path.points[:, :2] >= place.low).all()
            assert (path.points[:, :2] <= place.high).all()
        parts += found
    apart, whole = carved(relief, parts), carved(relief, paths)
    assert (apart - relief.heights).min() > -0.005
    low, high = places[0].overlap(places[1])
    x = GRID.node_axes()[0]
    seam = (x >= low[0] - 1.6) & (x <= high[0] + 1.6)
    figure = relief.heights[:, seam] < 0
    left = [np.quantile((h - relief.heights)[:, seam][figure], 0.99) for h in (apart, whole)]
    assert left[0] < left[1] + 0.01
    for one in (parts[:3], parts[3:]):
        alone = np.quantile((carved(relief, one) - relief.heights)[:, seam][figure], 0.99)
        assert alone > left[0] + 0.5


def test_marks_are_cut_last_into_the_finished_surface():
    smooth, cutter = figure(), profiles.cutter("ball-2")
    line = np.column_stack([np.linspace(8, 22, 60), 12 + 2 * np.cos(np.linspace(0, 3, 60))])
    peck = np.array([[3.0, 3.0], [3.0, 3.0]])
    x, y = np.meshgrid(*GRID.node_axes())
    away = np.min([np.hypot(x - u, y - v) for u, v in [*line, *peck]], axis=0)
    ground = np.where(smooth.heights < 0, smooth.heights, 0.0)
    tips = ground - 0.2 + cutter.profile(np.minimum(away, 0.99))
    marked = replace(smooth, heights=np.clip(np.minimum(ground, tips), -DEPTH, 0.0))
    machine, material = profiles.machine(), profiles.material()
    marks = Marks(cutter, smooth, (line, peck))
    paths = plan(marked, strokes(), machine, material, marks=[marks])
    plain = plan(smooth, strokes(), machine, material)
    assert [path.name for path in paths] == ["rough", "finish", "lines", "marks"]
    for one, other in zip(paths[:3], plain, strict=True):
        assert np.array_equal(one.points, other.points)
    left = carved(marked, paths) - marked.heights
    assert left.min() > -0.005
    new = (smooth.heights - marked.heights > 0.1) & (smooth.heights == 0)
    assert new.any() and left[new].max() < 0.02  # the peck
    assert np.hypot(*(paths[3].points[:, :2] - (3.0, 3.0)).T).min() < 1e-9


def test_a_panel_beyond_reach_says_what_to_try():
    machine = replace(profiles.machine(), travel=(20.0, 157.0, 34.0))
    with pytest.raises(InputError, match="--positions index or turn"):
        plan(figure(), (), machine, profiles.material())


def test_a_window_without_figure_has_no_paths():
    place = Position(1, 2, (0.0, 0.0), (3.0, 24.0), (0.0, 0.0))
    assert plan(figure(), (), profiles.machine(), profiles.material(), position=place) == ()
