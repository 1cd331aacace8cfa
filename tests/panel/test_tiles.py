from itertools import combinations
from math import cos, radians, tan

import manifold3d
import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.raster import rasterise
from relieffab.panel import tongues as module
from relieffab.panel.carve import make_panel
from relieffab.panel.export import write_stl
from relieffab.panel.model import Panel
from relieffab.panel.solid import manifold_of
from relieffab.panel.tiles import split
from relieffab.stock import Stock

CLEARANCE = 0.3


def bumpy_panel(make_relief, width=100.0, height=70.0):
    pitch = 0.5
    y, x = np.mgrid[0 : 2 * height + 1, 0 : 2 * width + 1] * pitch
    inside = np.hypot((x - width / 2) / 1.4, y - height / 2) < 0.4 * height
    h = np.where(inside, -1.5 + np.sin(x / 3) * np.cos(y / 4), 0.0)
    return make_panel(make_relief(h, pitch=pitch, rim=0.0), Stock(width, height, 8.0))


def assembled(tile):
    return manifold_of(tile.vertices, tile.faces, "a part").translate((*tile.place, 0.0))


@pytest.fixture(scope="module")
def plain():
    box = manifold3d.Manifold.cube((100.0, 70.0, 9.0)).translate((0.0, 0.0, -9.0)).to_mesh64()
    faces = np.array(box.tri_verts, np.int64)
    return Panel(np.array(box.vert_properties), faces, True, 63000.0, 0.0)


@pytest.fixture(scope="module")
def four(plain):
    return split(plain, (60.0, 42.0), CLEARANCE)


def test_parts_are_named_and_placed_from_the_far_left(four):
    assert [tile.name for tile in four] == ["A1", "A2", "B1", "B2"]
    assert [tile.place for tile in four] == [(0, 35), (50, 35), (0, 0), (50, 0)]


def test_volumes_add_up_but_for_the_clearance(four):
    lean, height = tan(radians(module.TAPER)), 3.0
    grown = module.WIDTH / 2 + CLEARANCE / cos(radians(module.TAPER))
    reach = module.LENGTH + CLEARANCE
    tongue = height * module.LENGTH * (module.WIDTH - module.LENGTH * lean)
    notch = (height + CLEARANCE) * reach * (2 * grown - reach * lean)
    # Seams of 35 and 50 mm, crossed by others, have room for one tongue each, and two.
    tongues = 2 * int(35 / 25.3) + 2 * int(50 / 25.3)
    lost = tongues * (notch - tongue)
    assert tongues == 4
    assert sum(tile.volume_mm3 for tile in four) == pytest.approx(63000 - lost, abs=1e-8)
    assert four[2].volume_mm3 == pytest.approx(63000 / 4 + 2 * tongue, abs=1e-8)
    assert four[1].volume_mm3 == pytest.approx(63000 / 4 - 2 * notch, abs=1e-8)


def test_seams_and_mouths_of_notches_lie_in_one_plane(four):
    for tile in four:
        from_seam = np.abs(tile.vertices[:, :2] - [50.0 * (tile.col == 0), 35.0 * (tile.row == 1)])
        assert not ((from_seam > 0) & (from_seam < 0.1)).any()


def test_no_two_parts_overlap(four):
    for one, other in combinations(four, 2):
        assert (assembled(one) ^ assembled(other)).volume() == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("axis", [0, 1])
def test_the_gap_is_the_clearance(four, axis):
    """The tongue, cut off at the seam, against the neighbour's notch."""
    own, neighbour = four[2], four[(3, 0)[axis]]
    far = np.zeros(3)
    far[axis] = (50.0, 35.0)[axis]
    half = manifold3d.Manifold.cube((200.0, 200.0, 20.0)).translate((-50.0, -50.0, -10.0))
    half = half.translate(tuple(np.where(np.arange(3) == axis, far + 50.001, 0.0)))
    tongue = assembled(own) ^ half
    assert tongue.volume() > 100
    assert tongue.min_gap(assembled(neighbour), 2.0) == pytest.approx(CLEARANCE, abs=1e-12)
    for way in (1.0, -1.0):
        side = np.zeros(3)
        side[1 - axis] = way
        for step in (side, np.array([0.0, 0.0, max(way, 0.0)]), far / far.max()):
            steps = [tuple(step * CLEARANCE * share) for share in (0.99, 1.1)]
            held = [(tongue.translate(s) ^ assembled(neighbour)).volume() for s in steps]
            assert held[0] == pytest.approx(0, abs=1e-9)
            assert held[1] > 1e-3 or not step.any()


def test_each_part_fits_the_bed_and_is_a_solid(make_relief, tmp_path):
    panel = bumpy_panel(make_relief)
    for bed in [(60.0, 42.0), (40.0, 70.0), (100.0, 40.0)]:
        tiles = split(panel, bed)
        assert len(tiles) == len({tile.name for tile in tiles}) > 1
        for tile in tiles:
            assert tile.watertight
            assert (np.ptp(tile.vertices[:, :2], axis=0) <= bed).all()
            mesh = trimesh.Trimesh(tile.vertices, tile.faces, process=False)
            assert mesh.is_volume
            assert mesh.volume == pytest.approx(tile.volume_mm3)
            write_stl(tile, tmp_path / "part.stl")
            assert trimesh.load_mesh(tmp_path / "part.stl").is_volume


def test_the_relief_goes_on_across_the_seams(make_relief):
    panel = bumpy_panel(make_relief)
    tiles = split(panel, (60.0, 42.0))
    points = [tile.vertices + np.array([*tile.place, 0.0]) for tile in tiles]
    starts = np.cumsum([0, *(len(p) for p in points)])
    faces = np.concatenate([t.faces + s for t, s in zip(tiles, starts, strict=False)])
    # Samples on both seams, too: at x = 50 and y = 35.
    grid = Grid(139, 199, 0.5, (0.25, 69.75))
    seen = rasterise(np.concatenate(points), faces, grid).depth
    assert np.abs(seen - rasterise(panel.vertices, panel.faces, grid).depth).max() < 1e-9


def test_tongues_lie_on_the_bed_under_the_relief(make_relief):
    panel = bumpy_panel(make_relief)
    tile = split(panel, (60.0, 42.0))[2]
    beyond = tile.vertices[tile.vertices[:, 0] > 50.0 + 1e-6]
    assert {-8.0, -8.0 + 8.0 / 3} == set(beyond[:, 2])
    assert beyond[:, 0].max() == 55.0


def test_without_clearance_tongues_fill_their_notches(plain):
    tiles = split(plain, (60.0, 42.0), 0.0)
    assert sum(tile.volume_mm3 for tile in tiles) == pytest.approx(63000)
    for one, other in combinations(tiles, 2):
        assert (assembled(one) ^ assembled(other)).volume() == pytest.approx(0, abs=1e-9)


def test_a_panel_that_fits_stays_whole(plain):
    (tile,) = split(plain, (100.0, 70.0))
    assert (tile.name, tile.place) == ("A1", (0.0, 0.0))
    assert tile.volume_mm3 == pytest.approx(63000)


@pytest.mark.parametrize(
    ("bed", "clearance", "words"),
    [
        ((4.0, 70.0), 0.2, "no room for a tongue"),
        ((18.0, 70.0), 0.2, "too small for their tongues"),
        ((60.0, 60.0), -0.1, "clearance"),
        ((60.0, 60.0), 1.1, "clearance"),
        ((60.0, 60.0), float("nan"), "clearance"),
    ],
)
def test_what_cannot_be_split_is_told(plain, bed, clearance, words):
    with pytest.raises(InputError, match=words):
        split(plain, bed, clearance)


def test_a_thin_slab_is_told(make_relief):
    deep = np.zeros((101, 141))
    deep[20:80, 20:120] = -1.9
    panel = make_panel(make_relief(deep, pitch=0.5, rim=0.0), Stock(70, 50, 4))
    with pytest.raises(InputError, match="too thin for tongues"):
        split(panel, (50.0, 60.0))
