import numpy as np
import pytest
from scipy.spatial import cKDTree

from relieffab.grid import Grid
from relieffab.layers.eye import Eye
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.strokes import draw_strokes
from relieffab.layers.raster import rasterise
from relieffab.layers.view import Placed

GRID = Grid.on_panel((40.0, 30.0), (400, 300))
STRAIGHT = Eye()


def ball(radius, centre=(0.0, 0.0, 0.0), rows=80, cols=120, shape=None):
    """A sphere with its poles on X, or any surface r(direction)."""
    i, j = np.meshgrid(np.arange(1, rows), np.arange(cols), indexing="ij")
    polar, around = np.pi * i.ravel() / rows, 2 * np.pi * j.ravel() / cols
    unit = np.stack(
        [np.cos(polar), np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around)], axis=1
    )
    unit = np.concatenate([unit, [[1.0, 0, 0], [-1.0, 0, 0]]])
    k = np.arange(rows - 2)[:, None] * cols + np.arange(cols)
    side = np.arange(rows - 2)[:, None] * cols + (np.arange(cols) + 1) % cols
    a, b, c, d = k.ravel(), (k + cols).ravel(), (side + cols).ravel(), side.ravel()
    n, ring = len(unit), np.arange(cols)
    after, last = (ring + 1) % cols, (rows - 2) * cols
    first = np.stack([np.full(cols, n - 2), ring, after], 1)
    end = np.stack([np.full(cols, n - 1), last + after, last + ring], 1)
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1), first, end])
    distance = radius if shape is None else shape(unit)[:, None]
    return distance * unit + np.asarray(centre), faces


def together(*meshes):
    starts = np.cumsum([0] + [len(v) for v, _ in meshes[:-1]])
    faces = [f + s for (_, f), s in zip(meshes, starts, strict=True)]
    return np.concatenate([v for v, _ in meshes]), np.concatenate(faces)


def draw(mesh, grid=GRID, eye=STRAIGHT, **options):
    placed = Placed.seen_from(eye, *mesh, np.eye(4))
    raster = rasterise(placed.vertices, placed.faces, grid)
    return draw_strokes(placed, raster, grid, Drawing(**{"secondary": 1.0, **options}))


def kinds(strokes):
    return sorted(stroke.kind for stroke in strokes)


def of_kind(strokes, kind):
    return [stroke for stroke in strokes if stroke.kind == kind]


def dense(stroke, step=0.02):
    points = np.concatenate([stroke.points, stroke.points[:1]]) if stroke.closed else stroke.points
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at = np.linspace(0, arc[-1], int(arc[-1] / step) + 2)
    return np.stack([np.interp(at, arc, points[:, k]) for k in (0, 1)], axis=1)


def length(stroke):
    return np.linalg.norm(np.diff(dense(stroke), axis=0), axis=1).sum()


def test_a_sphere_is_one_circle():
    (circle,) = draw(ball(10.0, (20, 15, 0)))
    assert circle.kind == "outline" and circle.closed
    error = np.linalg.norm(circle.points - [20, 15], axis=1) - 10
    assert np.abs(error).max() < 0.6 * GRID.pitch
    assert length(circle) == pytest.approx(20 * np.pi, rel=0.01)


def test_a_ball_before_a_ball_keeps_its_whole_circle():
    near, far = ball(4.0, (18, 15, 20)), ball(11.0, (20, 15, 0), rows=120, cols=180)
    strokes = draw(together(near, far))
    assert kinds(strokes) == ["contour", "outline"]
    (circle,) = of_kind(strokes, "contour")
    assert circle.closed and (circle.strength > 0.99).all()
    error = np.linalg.norm(dense(circle) - [18, 15], axis=1) - 4
    assert np.abs(error).max() < 0.5 * GRID.pitch
    assert length(circle) == pytest.approx(8 * np.pi, rel=0.01)


def test_a_ball_behind_a_ball_is_hidden():
    near, far = ball(10.0, (20, 15, 30), rows=120, cols=180), ball(4.0, (18, 15, 0))
    assert kinds(draw(together(near, far))) == ["outline"]


def test_a_ball_across_an_edge_leaves_an_arc_that_reaches_the_outline():
    near, far = ball(5.0, (11, 15, 30)), ball(10.0, (20, 15, 0), rows=120, cols=180)
    strokes = draw(together(near, far))
    assert kinds(strokes) == ["contour", "outline"]
    outline, arc = strokes
    assert not arc.closed
    error = np.linalg.norm(dense(arc) - [11, 15], axis=1) - 5
    assert np.abs(error).max() < GRID.pitch
    gap, _ = cKDTree(dense(outline)).query(arc.points[[0, -1]])
    assert gap.max() < 0.05
    # The circles cross at x with (x-11)^2 - 25 = (x-20)^2 - 100.
    x = (20**2 - 11**2 - 100 + 25) / 18
    assert arc.points[[0, -1], 0] == pytest.approx([x, x], abs=0.4)


def test_a_capsule_has_no_inner_line():
    def shape(unit):
        # Distance from the middle to a capsule of radius 5 about 10 mm of the X axis.
        across = np.linalg.norm(unit[:, 1:], axis=1)
        side = 5 / np.maximum(across, 1e-9)
        along = np.abs(unit[:, 0])
        cap = 5 * along + np.sqrt(np.maximum(25 - 25 * across**2, 0))
        return np.where(side * along <= 5, side, cap)

    strokes = draw(ball(1.0, (20, 15, 0), rows=160, cols=160, shape=shape))
    assert kinds(strokes) == ["outline"]


CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
BOX = np.array([[q[0], q[i], q[i + 1]] for q in QUADS for i in (1, 2)])


def turned_cube(half=7.0):
    c, s = np.cos(0.6), np.sin(0.6)
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ np.array(
        [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    )
    return half * CUBE @ turn.T + [20, 15, 0]


def test_a_cube_shows_three_creases_inside_its_outline():
    corners = turned_cube()
    strokes = draw((corners, BOX))
    assert kinds(strokes) == ["crease"] * 3 + ["outline"]
    nearest = corners[corners[:, 2].argmax(), :2]
    ends = [i for i in range(8) if np.abs(CUBE[i] - CUBE[corners[:, 2].argmax()]).sum() == 2]
    for stroke in of_kind(strokes, "crease"):
        line = dense(stroke)
        legs = [corners[e, :2] - nearest for e in ends]
        to = line - nearest
        off = [np.abs(leg[0] * to[:, 1] - leg[1] * to[:, 0]).max() for leg in legs]
        spans = [np.linalg.norm(corners[e, :2] - nearest) for e in ends]
        e = int(np.argmin(np.array(off) / spans))
        assert off[e] / spans[e] < 0.1
        assert length(stroke) == pytest.approx(spans[e], abs=0.8)


def test_an_open_dish_has_its_rim_and_no_nan():
    vertices, faces = ball(10.0, (20, 15, 0))
    tilt = np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    vertices = (vertices - [20, 15, 0]) @ tilt.T + [20, 15, 0]
    middle = vertices[faces].mean(axis=1) - [20, 15, 0]
    faces = faces[middle @ tilt[:, 2] < -2.0]  # a bowl, open towards the viewer
    strokes = draw((vertices, faces))
    assert {"outline", "boundary"} <= set(kinds(strokes))
    assert all(np.isfinite(s.points).all() and np.isfinite(s.strength).all() for s in strokes)


def bumpy(unit):
    return 10 + 0.2 * np.sin(25 * unit[:, 0]) * np.sin(25 * unit[:, 1]) * np.sin(25 * unit[:, 2])


def test_detail_calms_a_rough_surface():
    mesh = ball(1.0, (20, 15, 0), rows=100, cols=150, shape=bumpy)
    rough = draw(mesh, detail=0.0, min_length=0.5)
    calm = draw(mesh, detail=8.0, min_length=0.5)
    assert sum(length(s) for s in rough if s.kind == "suggestive") > 50
    assert kinds(calm) == ["outline"]


def twice_grooved(unit):
    """A ball with two grooves 2 mm apart round its X axis."""
    polar = np.arccos(np.clip(unit[:, 0], -1, 1))
    return 10 - sum(0.3 * np.exp(-(((polar - at) / 0.05) ** 2)) for at in (1.1, 1.3))


def test_of_two_lines_side_by_side_the_longer_stays():
    mesh = ball(1.0, (20, 15, 0), rows=240, cols=120, shape=twice_grooved)
    close, apart = (draw(mesh, detail=0.0, spacing=spacing) for spacing in (2.5, 1.0))
    assert kinds(apart) == ["outline", "suggestive", "suggestive"]
    assert kinds(close) == ["outline", "suggestive"]
    assert length(close[1]) == pytest.approx(max(length(s) for s in apart[1:]), rel=0.1)


def test_a_crease_beside_the_outline_is_left_out():
    # Turned so little that its side shows as a sliver of 0.56 mm.
    c, s = np.cos(0.04), np.sin(0.04)
    corners = 7 * CUBE @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]) + [20, 15, 0]
    close, apart = (draw((corners, BOX), spacing=spacing) for spacing in (2.0, 0.6))
    assert kinds(apart) == ["crease", "outline"]
    assert kinds(close) == ["outline"]


def torus_mesh(m=160, n=100):
    i, j = (q.ravel() for q in np.meshgrid(np.arange(m), np.arange(n), indexing="ij"))
    theta, phi = 2 * np.pi * i / m, 2 * np.pi * j / n
    rho = 8 + 3.4 * np.cos(phi)
    points = np.stack([rho * np.cos(theta), rho * np.sin(theta), 3.4 * np.sin(phi)], axis=1)
    c, s = np.cos(1.3), np.sin(1.3)
    points = points @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]]).T + [20, 15, 0]
    a, b = i * n + j, (i + 1) % m * n + j
    c, d = (i + 1) % m * n + (j + 1) % n, i * n + (j + 1) % n
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def test_a_torus_seen_aslant_shows_its_inner_contour_up_to_its_cusps():
    strokes = draw(torus_mesh())
    inner = [s for s in strokes if s.kind == "contour"]
    assert len(inner) == 1 and not inner[0].closed
    # The front of the hole: symmetric about x = 20, as the torus is.
    line = dense(inner[0])
    mirrored = line * [-1, 1] + [40, 0]
    assert cKDTree(line).query(mirrored)[0].max() < 0.5


@pytest.mark.parametrize("kind", ["faces", "vertices", "int32"])
def test_strokes_do_not_depend_on_how_the_mesh_is_written(kind):
    points, faces = torus_mesh(100, 60)
    rng = np.random.default_rng(4)
    order = np.arange(len(points))
    other = rng.permutation(faces) if kind == "faces" else faces.astype(np.int32)
    if kind == "vertices":
        order = rng.permutation(len(points))
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        other = place[faces]
    one, two = draw((points, faces)), draw((points[order], other))
    assert kinds(one) == kinds(two)
    a, b = (np.concatenate([dense(s) for s in strokes]) for strokes in (one, two))
    assert max(cKDTree(a).query(b)[0].max(), cKDTree(b).query(a)[0].max()) < GRID.pitch


def test_strokes_move_and_grow_with_the_model():
    points, faces = torus_mesh(100, 60)
    wide = Grid(GRID.rows, GRID.cols, 3 * GRID.pitch, (3 * 5.0, 3 * 42.0))
    shift = np.array([5.0, 12.0, -40.0])
    moved = 3 * (points + shift)
    options = {"detail": 0.5, "min_length": 2.0, "spacing": 0.5, "tolerance": 0.01}
    one = draw((points, faces), **options)
    two = draw((moved, faces), wide, **{name: 3 * value for name, value in options.items()})
    assert kinds(one) == kinds(two)
    a = np.concatenate([dense(s) for s in one])
    b = np.concatenate([dense(s) for s in two]) / 3 - shift[:2]
    assert max(cKDTree(a).query(b)[0].max(), cKDTree(b).query(a)[0].max()) < GRID.pitch


def test_short_lines_are_left_out():
    mesh = torus_mesh(100, 60)
    lengths = [length(s) for s in draw(mesh, min_length=6.0) if s.kind != "outline"]
    assert lengths and min(lengths) > 5.5
    assert kinds(draw(mesh, min_length=40.0)) == ["outline"]


def test_input_stays_as_it_is():
    vertices, faces = torus_mesh(40, 30)
    vertices.flags.writeable = faces.flags.writeable = False
    draw((vertices, faces))


def test_bad_triangles_do_no_harm():
    vertices, faces = ball(10.0, (20, 15, 0))
    vertices = np.concatenate([vertices, [[20.0, 15.0, 3.0]]])
    faces = np.concatenate([faces, faces[:50], [[3, 3, 3], [0, 1, 1]]])
    strokes = draw((vertices, faces))
    assert all(np.isfinite(s.points).all() for s in strokes)
    assert "suggestive" not in kinds(strokes)


def test_a_model_out_of_sight_has_no_strokes():
    assert draw(ball(3.0, (200, 15, 0), rows=8, cols=8)) == ()


def test_secondary_lines_have_their_share_of_strength():
    mesh = ball(1.0, (20, 15, 0), rows=240, cols=120, shape=twice_grooved)
    strokes = draw(mesh, detail=0.0, spacing=1.0, secondary=0.4)
    assert 0.2 < max(s.strength.max() for s in of_kind(strokes, "suggestive")) <= 0.4
    assert of_kind(strokes, "outline")[0].strength.max() == 1.0


def test_an_outline_that_is_not_wanted_is_not_drawn():
    near, far = ball(4.0, (18, 15, 20)), ball(11.0, (20, 15, 0), rows=120, cols=180)
    assert kinds(draw(together(near, far), kinds=("contour",))) == ["contour"]


@pytest.mark.parametrize("slope", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("turned", [0.0, 0.01, 0.03])
def test_the_floor_of_a_groove_is_one_crease(slope, turned):
    x, y = np.array([-3.0, 0, 3, -3, 0, 3]), np.array([-8.0, -8, -8, 8, 8, 8])
    c, s = np.cos(turned), np.sin(turned)
    vertices = np.stack([20 + c * x - s * y, 15 + s * x + c * y, slope * np.abs(x)], axis=1)
    faces = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    (floor,) = of_kind(draw((vertices, faces), min_length=1.0), "crease")
    assert length(floor) == pytest.approx(16.0, abs=0.5)


def test_a_cone_has_no_contour_of_its_apex():
    angle = 2 * np.pi * np.arange(64) / 64
    rim = np.stack([8 * np.cos(angle), 8 * np.sin(angle), np.zeros(64)], axis=1)
    vertices = np.concatenate([rim, [[0, 0, 16.0], [0, 0, 0.0]]])
    after = (np.arange(64) + 1) % 64
    sides = np.stack([np.arange(64), after, np.full(64, 64)], axis=1)
    base = np.stack([after, np.arange(64), np.full(64, 65)], axis=1)
    c, s = np.cos(np.radians(65)), np.sin(np.radians(65))
    tilt = np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    mesh = vertices @ tilt.T + [20, 10, 0], np.concatenate([sides, base])
    assert set(kinds(draw(mesh))) <= {"outline", "crease"}


def test_the_inside_of_an_open_surface_is_drawn_like_its_outside():
    points, faces = torus_mesh()
    half = points[faces].mean(axis=1)[:, 0] > 14.0  # a rim, so that both sides count
    one, other = draw((points, faces[half])), draw((points, faces[half][:, ::-1]))
    assert kinds(one) == kinds(other)
    a, b = (np.concatenate([dense(s) for s in strokes]) for strokes in (one, other))
    assert max(cKDTree(a).query(b)[0].max(), cKDTree(b).query(a)[0].max()) < GRID.pitch
