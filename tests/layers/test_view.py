import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.layers.mesh import make_mesh
from relieffab.layers.view import View, guess_up, named_view, place

# A point on each axis of a z-up model that faces -Y.
RIGHT, BACK, TOP = np.eye(3)


@pytest.mark.parametrize(
    ("name", "across", "upward", "toward"),
    [
        ("front", RIGHT, TOP, -BACK),
        ("back", -RIGHT, TOP, BACK),
        ("right", BACK, TOP, RIGHT),
        ("left", -BACK, TOP, -RIGHT),
        ("top", RIGHT, BACK, TOP),
        ("bottom", RIGHT, -BACK, -TOP),
    ],
)
def test_named_views_of_a_z_up_model(name, across, upward, toward):
    np.testing.assert_allclose(
        named_view(name, "z").rotation, np.stack([across, upward, toward]), atol=1e-12
    )


def test_y_up_front_looks_along_z_and_keeps_x():
    np.testing.assert_allclose(View(up="y").rotation, np.eye(3), atol=1e-12)


def test_roll_turns_the_picture_counter_clockwise():
    turned = View(up="y", roll=90).rotation @ [1.0, 0, 0]
    np.testing.assert_allclose(turned, [0, 1, 0], atol=1e-12)


def test_every_view_is_a_rotation():
    for azimuth, elevation, roll in [(17, 33, -50), (200, -80, 10), (-90, 90, 0)]:
        r = View(azimuth, elevation, roll, "z").rotation
        np.testing.assert_allclose(r @ r.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(r) == pytest.approx(1)


def test_placed_model_fills_the_room_and_matches_its_matrix(model):
    placed = place(model, View(20, 30, 10, "y"), (120.0, 90.0), margin=6.0)
    low, high = placed.vertices.min(axis=0), placed.vertices.max(axis=0)
    assert high[2] == pytest.approx(0)
    assert np.minimum(low[:2], [120, 90] - high[:2]).min() == pytest.approx(6)
    np.testing.assert_allclose((low + high)[:2] / 2, [60, 45])
    again = model.vertices @ placed.matrix[:3, :3].T + placed.matrix[:3, 3]
    np.testing.assert_allclose(again, placed.vertices, atol=1e-9)


def test_size_of_the_model_does_not_change_the_panel(model):
    small = make_mesh(model.vertices * 1e-9, model.faces)
    huge = make_mesh(model.vertices * 1e9 + 1e9, model.faces)
    a = place(small, View(up="y"), (120.0, 90.0), margin=6.0).vertices
    b = place(huge, View(up="y"), (120.0, 90.0), margin=6.0).vertices
    np.testing.assert_allclose(np.sort(a, axis=0), np.sort(b, axis=0), atol=1e-4)


@pytest.mark.parametrize("squash", [[1, 1, 0], [0, 1, 1], [1e-6, 1e-6, 1]])
def test_flat_and_needle_models_are_refused(squash):
    box = trimesh.creation.box((1, 1, 1))
    vertices = box.vertices * squash + [0, 0, 1e-9] * box.vertices
    mesh = make_mesh(vertices, box.faces[:2] if 0 in squash else box.faces)
    with pytest.raises(InputError, match=r"flat as seen|edge on"):
        place(mesh, View(up="y"), (120.0, 90.0), margin=6.0)


def test_a_margin_that_leaves_no_room_is_refused(model):
    with pytest.raises(InputError, match="margin"):
        place(model, View(), (120.0, 90.0), margin=45.0)


def test_up_is_where_the_foot_is_not():
    cone = trimesh.creation.cone(radius=1, height=3)
    assert guess_up(make_mesh(cone.vertices, cone.faces)) == "z"
    lying = cone.vertices[:, [0, 2, 1]] * [1, 1, -1]
    assert guess_up(make_mesh(lying, cone.faces)) == "y"


def test_the_format_decides_where_the_foot_does_not():
    ball = trimesh.creation.icosphere()
    for axis in "yz":
        assert guess_up(make_mesh(ball.vertices, ball.faces, usual_up=axis)) == axis


def test_unknown_view_is_refused_with_a_suggestion():
    with pytest.raises(InputError, match="did you mean front"):
        named_view("frontal", "z")


@pytest.mark.parametrize("angle", [5.0, 40.0, 120.0])
def test_a_model_in_perspective_fills_the_room_and_matches_its_matrix(model, angle):
    placed = place(model, View(20, 30, 10, "y", angle), (120.0, 90.0), margin=6.0)
    low, high = placed.vertices.min(axis=0), placed.vertices.max(axis=0)
    assert high[2] == pytest.approx(0, abs=1e-9)
    assert np.minimum(low[:2], [120, 90] - high[:2]).min() == pytest.approx(6)
    homogeneous = np.column_stack([model.vertices, np.ones(len(model.vertices))]) @ placed.matrix.T
    np.testing.assert_allclose(homogeneous[:, :3] / homogeneous[:, 3:], placed.vertices, atol=1e-9)
    np.testing.assert_allclose(placed.eye.project(placed.solid), placed.vertices)


def test_the_bounding_sphere_fills_the_angle_of_view():
    ball = trimesh.creation.icosphere(subdivisions=4)
    placed = place(make_mesh(ball.vertices, ball.faces), View(perspective=60), (90, 90), margin=0)
    at = np.array([placed.eye.x, placed.eye.y, 1 / placed.eye.nearness])
    middle = (placed.solid.min(axis=0) + placed.solid.max(axis=0)) / 2
    radius = np.ptp(placed.solid[:, 0]) / 2
    assert np.degrees(np.arcsin(radius / np.linalg.norm(at - middle))) == pytest.approx(30, abs=0.1)


def test_a_small_angle_of_view_is_almost_orthographic(model):
    near = place(model, View(20, 30, up="y", perspective=0.01), (120.0, 90.0), margin=6.0)
    far = place(model, View(20, 30, up="y"), (120.0, 90.0), margin=6.0)
    np.testing.assert_allclose(near.vertices, far.vertices, atol=0.02)
    np.testing.assert_array_equal(far.solid, far.vertices)


@pytest.mark.parametrize("angle", [-1.0, 121.0])
def test_an_angle_of_view_out_of_range_is_refused(angle):
    with pytest.raises(InputError, match="angle of view"):
        View(perspective=angle)
