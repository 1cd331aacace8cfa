import numpy as np

from relieffab.relief.window import BORDER, Window, cropped


def test_a_window_gives_back_what_it_took():
    whole = np.arange(42.0).reshape(6, 7)
    window = Window(-2, 3, 5, 9)
    back = window.put(window.take(whole), whole.shape)
    np.testing.assert_array_equal(back[:4, 3:], whole[:4, 3:])
    assert (back[4:] == 0).all()


def test_the_figure_is_cut_out_with_its_border(layers):
    part, window = cropped(layers)
    assert part.mask.sum() == layers.mask.sum()
    assert not part.mask[:BORDER].any()
    assert part.mask[BORDER].any()
    row, col = np.argwhere(part.mask)[0]
    assert part.depth[row, col] == layers.depth[row + window.top, col + window.left]
    assert part.grid.to_xy(0, 0) == layers.grid.to_xy(window.top, window.left)
