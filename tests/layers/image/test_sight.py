import numpy as np

from relieffab.layers.image.make import Known, Showing, figure_of, sight_of_picture
from relieffab.layers.lines.drawing import Drawing


def test_a_sight_is_drawn_time_and_again(stone, depth_map):
    picture, _ = depth_map(stone, 16)
    sight = sight_of_picture(picture, stone.grid, (40.0, 30.0), margin=3.0)
    assert not sight.lines_only and sight.grid == stone.grid
    strokes = sight.strokes(Drawing())
    thin, bold = (sight.layers(strokes, Drawing(width=width)) for width in (0.4, 1.2))
    assert thin.depth is bold.depth and thin.strokes is bold.strokes
    assert bold.lines.sum() > 1.5 * thin.lines.sum()
    assert not sight.bare.lines.any()


def test_what_is_known_of_a_picture_is_not_looked_for(stone, depth_map):
    picture, _ = depth_map(stone, 16)
    mask, _ = figure_of(picture, "depth")
    half = mask & (np.arange(mask.shape[1]) < mask.shape[1] // 2)
    showing = Showing(mask="nowhere.png")
    known = Known("depth", (half, "somebody"))
    sight = sight_of_picture(
        picture, stone.grid, (40.0, 30.0), margin=3.0, showing=showing, known=known
    )
    assert (sight.facts["mask"], sight.facts["kind_by"]) == ("somebody", "values")
