"""Reliefs in stocks with a shape: the whole way from heights to a solid."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.errors import InputError
from relieffab.fittings import Edge, Frame, Hole, Keyhole
from relieffab.grid import Grid
from relieffab.panel.carve import largest_error, make_panel
from relieffab.panel.plaque import make_plaque
from relieffab.panel.weld import weld
from relieffab.relief.model import Relief
from relieffab.stock import Stock

pytest.importorskip("cadquery", exc_type=ImportError)
HEIGHTS = st.one_of(st.just(0.0), st.sampled_from([-0.5, -1.0]), st.floats(-2, 0, width=16))
FRAMES = st.builds(
    Frame,
    st.floats(3, 6),
    st.sampled_from([-2.0, 1.5, 3.0]),
    st.sampled_from([None, Edge("chamfer", 1.0), Edge("fillet", 1.0)]),
)


@st.composite
def stocks(draw):
    shape = draw(st.sampled_from(["rectangle", "round", "arched"]))
    return Stock(
        30,
        40,
        draw(st.sampled_from([5.0, 10.0])),
        shape=shape,
        corner=0.0 if shape == "round" else draw(st.sampled_from([0.0, 2.0, 5.0])),
        frame=draw(st.none() | FRAMES),
        holes=draw(st.sampled_from([(), (Hole((15, 8), 2, 3.5),), (Hole((15, 9), 1.5),)])),
    )


def whole_grid(stock, pitch):
    cols, rows = round(stock.width / pitch), round(stock.height / pitch)
    return Grid(rows, cols, pitch, (0.0, rows * pitch))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.data())
def test_any_relief_in_any_stock_is_a_volume_within_tolerance_or_refused(data):
    try:
        stock = data.draw(stocks())
    except InputError:
        return
    grid = whole_grid(stock, 1.0)
    heights = np.zeros(grid.node_shape)
    heights[15:26, 10:21] = data.draw(arrays(float, (11, 11), elements=HEIGHTS))
    relief = Relief(grid, heights, np.ones(grid.shape, bool), 2.0)
    try:
        panel = make_panel(relief, stock, tolerance=0.02)
    except InputError as refused:
        assert "off the stock's face" in str(refused) or "cannot give the frame" in str(refused)
        return
    assert panel.max_error_mm <= 0.02
    for vertices, faces in ((panel.vertices, panel.faces), weld(panel.vertices, panel.faces)):
        assert trimesh.Trimesh(vertices, faces, process=False).is_volume


def pit(stock, depth=2.0):
    grid = whole_grid(stock, 0.5)
    heights = np.zeros(grid.node_shape)
    rows, cols = grid.node_shape
    heights[rows // 2 - 6 : rows // 2 + 7, cols // 2 - 6 : cols // 2 + 7] = -depth
    mask = np.zeros(grid.shape, bool)
    mask[rows // 2 - 7 : rows // 2 + 7, cols // 2 - 7 : cols // 2 + 7] = True
    return Relief(grid, heights, mask, depth)


def test_the_cut_takes_the_same_volume_from_every_stock():
    plain = Stock(30, 40, 10)
    whole = 30 * 40 * 10 - make_panel(pit(plain), plain).volume_mm3
    framed = replace(plain, frame=Frame(5, 2))
    assert 30 * 40 * 12 - 20 * 30 * 2 - make_panel(pit(framed), framed).volume_mm3 == pytest.approx(
        whole
    )


def test_an_error_beside_the_frame_is_seen_and_the_frame_is_not_one():
    stock = Stock(30, 40, 10, frame=Frame(5, 2, Edge("chamfer", 1)), keyholes=(Keyhole((15, 33)),))
    relief = pit(stock)
    panel = make_panel(relief, stock)
    assert panel.max_error_mm < 1e-6
    floor = np.isclose(panel.vertices[:, 2], -2)
    lifted = panel.vertices + floor[:, None] * [0.0, 0.0, 0.5]
    assert largest_error(lifted, panel.faces, relief, stock) == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"frame": Frame(12, 2)}, "(?s)off the stock's face.*frame and holes"),
        ({"holes": (Hole((15, 20), 3),)}, "(?s)off the stock's face.*outline and holes"),
        ({"thickness": 7.6, "keyholes": (Keyhole((15, 33)),)}, "break through to a keyhole"),
    ],
)
def test_a_cut_that_meets_frame_hole_or_keyhole_is_refused(more, message):
    stock = Stock(**{"width": 30, "height": 40, "thickness": 10, **more})
    with pytest.raises(InputError, match=message):
        make_panel(pit(stock), stock)


def test_a_plaque_on_a_round_base_with_a_keyhole():
    stock = Stock(30, 40, 10, shape="round", keyholes=(Keyhole((15, 25)),))
    sunk = pit(stock)
    figure = replace(sunk, heights=np.maximum(sunk.heights, -0.5))
    plaque = make_plaque(figure, stock)
    mesh = trimesh.Trimesh(plaque.vertices, plaque.faces, process=False)
    assert mesh.is_volume
    assert mesh.bounds == pytest.approx(np.array([[0, 0, -12], [30, 40, -0.5]]), abs=0.01)
    plain = make_plaque(figure, Stock(30, 40, 10))
    less = 30 * 40 * 10 - np.pi * 15 * 20 * 10
    key = plain.volume_mm3 - less - plaque.volume_mm3
    assert 600 < key < 800  # of the keyhole alone: 3.5 mm of 154, and 2 mm of 100 mm²
    with pytest.raises(InputError, match="no frame"):
        make_plaque(pit(stock), replace(stock, frame=Frame(3, 2)))
