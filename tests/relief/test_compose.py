import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.compose import compose, laid_out, walls_of
from relieffab.relief.edge import inward_distance
from relieffab.relief.model import Relief, inner_nodes, nodes_of
from relieffab.relief.placed import Placed

RNG = np.random.default_rng(3)


def relief(rows=12, cols=16, pitch=0.5, depth=2.0):
    """Noise in the middle of a small panel."""
    grid = Grid(rows, cols, pitch, (0.0, rows * pitch))
    mask = np.zeros(grid.shape, bool)
    mask[3:-3, 3:-3] = True
    heights = np.where(inner_nodes(mask), -depth * RNG.random(grid.node_shape), 0.0)
    return Relief(grid, heights, mask, depth)


def test_whole_pixels_apart_nothing_changes():
    one, other = relief(), relief(depth=3.0)
    made = compose([Placed(one, (1, 2), "a"), Placed(other, (11.5, 2), "b")], (20.25, 9))
    assert made.depth == 3.0
    assert made.grid.pitch == 0.5
    for part, (x, y) in ((one, (1, 2)), (other, (11.5, 2))):
        row, col = (round(v) for v in made.grid.to_index(x, y + 6))
        np.testing.assert_array_equal(made.heights[row : row + 13, col : col + 17], part.heights)
        np.testing.assert_array_equal(made.mask[row : row + 12, col : col + 16], part.mask)
    assert made.mask.sum() == one.mask.sum() + other.mask.sum()
    x, y = made.grid.node_axes()
    assert 0 <= x[0] < 0.5
    assert 20.25 - 0.5 < x[-1] <= 20.25
    assert 0 <= y[-1] < 0.5
    assert 9 - 0.5 < y[0] <= 9


def test_a_coarser_one_is_sampled_on_its_own_triangles():
    fine, coarse = relief(pitch=0.25), relief(pitch=0.7)
    made = compose([Placed(coarse, (0.1, 0.2), "a"), Placed(fine, (12, 0.3), "b")], (17, 9))
    x, y = made.grid.node_axes()
    want = coarse.height_at(x[None, :] - 0.1, y[:, None] - 0.2)
    want += fine.height_at(x[None, :] - 12, y[:, None] - 0.3)
    np.testing.assert_allclose(made.heights, want, atol=1e-12)
    assert made.grid.pitch == 0.25
    assert not made.heights[~nodes_of(made.mask)].any()
    area = (made.mask.sum() * 0.25**2, coarse.mask.sum() * 0.7**2 + fine.mask.sum() * 0.25**2)
    assert area[0] == pytest.approx(area[1], rel=0.15)


@pytest.mark.parametrize(
    ("places", "message"),
    [
        ([], "no relief to lay out"),
        ([(-0.1, 0)], "a reaches beyond"),
        ([(0, 0), (13, 0)], "b reaches beyond"),
        ([(0, 0), (2, 0)], "(?s)b overlaps a.*both at X"),
    ],
)
def test_places_that_do_not_fit_are_refused(places, message):
    parts = [Placed(relief(), at, "ab"[k]) for k, at in enumerate(places)]
    with pytest.raises(InputError, match=message):
        compose(parts, (20, 6))


def test_a_panel_of_too_many_pixels_is_refused():
    with pytest.raises(InputError, match="too many pixels"):
        compose([Placed(relief(pitch=0.01), (0, 0), "a")], (200, 10))


def test_walls_are_laid_out_each_at_its_own_angle():
    one, other = relief(24, 40), relief(24, 40)
    places = ((1, 2), (23, 2))
    made = compose(
        [Placed(r, at, "a") for r, at in zip((one, other), places, strict=True)], (44, 16)
    )
    walls = walls_of(one, 80.0), walls_of(other, 45.0)
    edge = laid_out([Placed(w, at, "a") for w, at in zip(walls, places, strict=True)], made.grid)
    for (x, y), tangent in zip(places, (np.tan(np.radians(80.0)), 1.0), strict=True):
        row, col = (round(v) for v in made.grid.to_index(x, y + 12))
        inside = inward_distance(one.mask)
        found = edge[row : row + 25, col : col + 41][inside > 3]
        np.testing.assert_allclose(found, -tangent * 0.5 * (inside[inside > 3] - 1.0))
    assert not edge[~nodes_of(made.mask)].any()


def test_pecks_may_not_lie_on_another_figure():
    grid = Grid(12, 16, 0.5, (0.0, 6.0))
    none = np.zeros(grid.shape, bool)
    peck = np.zeros(grid.node_shape)
    peck[6, 14] = -0.2
    one, other = relief(), Relief(grid, peck, none, 2.0)
    places = [Placed(one, (7.5, 0), "a"), Placed(other, (3, 0), "b")]
    made = compose([places[0]], (16, 6))
    assert (laid_out(places[:1], made.grid) == made.heights).all()
    with pytest.raises(InputError, match=r"(?s)b overlaps a.*pecked ground"):
        laid_out(places, made.grid)


def test_round_a_seam_a_relief_is_the_same_as_elsewhere():
    """Placed a whole number of pixels further round, everything is rolled by as many."""
    one, other = relief(), relief(rows=6, depth=3.0)
    size = (20.0, 9.0)

    def made(x):
        return compose(
            [Placed(one, (x, 2), "a"), Placed(other, (x + 9, 1), "b")], size, joined=True
        )

    middle, across = made(1.0), made(16.5)
    assert middle.grid.pitch == 0.5 and middle.grid.cols == 40
    assert across.mask[:, :4].any() and across.mask[:, -4:].any()
    np.testing.assert_array_equal(across.heights[:, 0], across.heights[:, -1])
    np.testing.assert_allclose(
        across.heights[:, :-1], np.roll(middle.heights[:, :-1], 31, axis=1), atol=1e-12
    )
    parts = [Placed(one, (16.5, 2), "a"), Placed(other, (25.5, 1), "b")]
    np.testing.assert_array_equal(laid_out(parts, across.grid, joined=True), across.heights)
    np.testing.assert_array_equal(across.mask, np.roll(middle.mask, 31, axis=1))
    np.testing.assert_allclose(made(16.5 - 3 * 20).heights, across.heights, atol=1e-12)


def test_a_frieze_that_meets_itself_is_taken_once():
    grid = Grid(8, 40, 0.5, (0.0, 4.0))
    heights = np.zeros(grid.node_shape)
    heights[2:-2] = -1.0
    frieze = Relief(grid, heights, np.ones(grid.shape, bool), 1.0)
    made = compose([Placed(frieze, (0, 0), "a")], (20.0, 4.0), joined=True)
    np.testing.assert_array_equal(made.heights, heights)


def test_where_edges_meet_pixels_go_round_a_whole_number_of_times():
    made = compose([Placed(relief(pitch=0.7), (19, 0), "a")], (31.41, 9), joined=True)
    assert made.grid.pitch * made.grid.cols == pytest.approx(31.41, abs=1e-12)
    assert 0.68 < made.grid.pitch <= 0.7
    assert made.grid.origin[0] == 0.0


def test_figures_that_overlap_round_the_seam_are_refused():
    parts = [Placed(relief(), (17, 0), "a"), Placed(relief(), (0, 0), "b")]
    with pytest.raises(InputError, match="b overlaps a"):
        compose(parts, (20.0, 9.0), joined=True)
    with pytest.raises(InputError, match="beyond the panel"):
        compose([Placed(relief(), (0, 0), "a")], (7.9, 9.0), joined=True)
