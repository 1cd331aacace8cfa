import numpy as np

from relieffab.layers.model import Stroke
from relieffab.relief.quality.drawn import FAINT, centre_points, drawn


def test_points_stand_a_pixel_apart_along_the_dark_lines(bench, waves):
    light = Stroke(np.array([[5.0, 5.0], [5.0, 25.0]]), "suggestive-highlight", np.ones(2))
    points = centre_points(bench.layers_of(waves, strokes=(bench.line(), light)))
    assert len(points) == 20.0 / bench.pitch
    np.testing.assert_allclose(points[:, 1], 80)
    np.testing.assert_allclose(np.abs(np.diff(points[:, 0])), 1)


def test_closed_strokes_close_and_faint_ones_count_for_nothing(bench, waves):
    ring = np.array([[5.0, 5.0], [15.0, 5.0], [15.0, 15.0], [5.0, 15.0]])
    closed = Stroke(ring, "contour", np.ones(4), closed=True)
    faint = bench.line(strength=FAINT)
    points = centre_points(bench.layers_of(waves, strokes=(closed, faint)))
    assert len(points) == 40.0 / bench.pitch


def test_without_strokes_the_ink_is_thinned(bench, waves):
    ink = np.zeros(bench.grid.shape)
    ink[30:90, 79:82] = 0.8
    points = centre_points(bench.layers_of(waves, lines=ink))
    np.testing.assert_allclose(points[:, 1], 80.5, atol=1)
    assert 55 <= len(points) <= 62


def test_on_is_beside_the_line_and_off_four_to_eight_pixels_away(bench, waves):
    found = drawn(bench.pair_of(waves, waves, strokes=(bench.line(),)))
    assert np.nonzero(found.on[60])[0].tolist() == [79, 80, 81]
    assert np.nonzero(found.off[60])[0].tolist() == [*range(72, 77), *range(84, 89)]


def test_off_is_no_nearer_to_another_line(bench, waves):
    beside = Stroke(np.array([[21.6, 5.0], [21.6, 25.0]]), "suggestive", np.ones(2))
    found = drawn(bench.pair_of(waves, waves, strokes=(bench.line(), beside)))
    cols = np.nonzero(found.off[60])[0]
    assert cols.tolist() == [*range(72, 77), *range(90, 95)]


def test_outlines_are_no_lines_inside_but_keep_off_away(bench, waves, square):
    edge = Stroke(np.array([[2.6, 5.0], [2.6, 25.0]]), "outline", np.ones(2))
    alone = drawn(bench.pair_of(waves, 0 * waves, mask=square, strokes=(edge,)))
    assert not alone.on.any()
    assert not alone.off.any()
    assert len(alone.points) == 0


def test_a_model_without_lines(bench, waves):
    found = drawn(bench.pair_of(waves, waves))
    assert found.points.shape == (0, 2)
    assert not found.on.any()
