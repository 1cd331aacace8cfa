"""The panel in perspective; drawn where there is OpenGL, and plainly refused where not."""

from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from relieffab.grid import Grid
from relieffab.picture import OpenGLMissingError, panel_picture, render, solid_picture
from relieffab.picture.above import heights_above, solid_heights
from relieffab.relief.model import Relief


def slab(size=(12.0, 9.0, 3.0)):
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (-1, 0)], float)
    faces = [
        (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
        (2, 3, 7), (2, 7, 6), (1, 5, 7), (1, 7, 3), (0, 2, 6), (0, 6, 4),
    ]  # fmt: skip
    return SimpleNamespace(vertices=corners * size, faces=np.array(faces))


@pytest.fixture
def relief():
    grid = Grid.on_panel((12.0, 9.0), (64, 48))
    return Relief(grid, np.zeros(grid.node_shape), np.zeros(grid.shape, bool), 1.0)


def no_opengl(*_):
    raise OpenGLMissingError("OpenGL cannot be opened")


def test_camera_sees_the_box_and_no_more_than_it_must():
    low, high = np.array([0.0, 0.0, -3.0]), np.array([12.0, 9.0, 0.0])
    pose = render.camera_pose(low, high, 4 / 3)
    np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-12)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1)
    corners = np.array([[x, y, z] for x in (0, 12) for y in (0, 9) for z in (-3, 0)], float)
    local = (corners - pose[:3, 3]) @ pose[:3, :3]
    reach = np.tan(np.radians(render.FIELD_OF_VIEW) / 2)
    on_screen = local[:, :2] / -local[:, 2:] / (reach * np.array([4 / 3, 1]))
    assert np.abs(on_screen).max() == pytest.approx(render.FILL)


def test_sides_and_back_are_told_from_the_face():
    box = slab()
    side = render.side_faces(box.vertices, box.faces)
    assert np.flatnonzero(~side).tolist() == [8, 9]


def test_without_a_panel_it_is_seen_straight_on(relief):
    image, method = panel_picture(relief)
    assert method == "hillshade"
    assert image.shape == (48, 64, 3)


def test_without_opengl_the_hillshade_serves_and_says_so(relief, monkeypatch):
    monkeypatch.setattr(render, "_open_renderer", no_opengl)
    image, method = panel_picture(relief, slab())
    assert method == "hillshade"
    assert image.shape == (48, 64, 3)


def test_a_renderer_that_will_not_open_is_named(monkeypatch):
    pyrender = pytest.importorskip("pyrender")

    def refuse(*_):
        raise RuntimeError("no display")

    monkeypatch.setenv("PYOPENGL_PLATFORM", "egl")
    monkeypatch.setattr(pyrender, "OffscreenRenderer", refuse)
    with pytest.raises(OpenGLMissingError, match="no display"):
        render.render_panel(slab(), np.zeros((4, 4, 3), np.uint8), Grid(4, 4, 1.0, (0, 4)))


@pytest.mark.parametrize("cols", [64, 61])  # rows of whole words, and of others
def test_panel_is_drawn_with_its_face_the_right_way_round(cols):
    box = slab()
    face = np.zeros((48, cols, 3), np.uint8)
    half = cols // 2
    face[:24, :half, 0] = face[:24, half:, 1] = face[24:, :half, 2] = 255
    face[24:, half:] = 255
    grid = Grid(48, cols, 12 / cols, (0.0, 9.0))
    try:
        image = render.render_panel(box, face, grid, width=320)
    except OpenGLMissingError as missing:
        pytest.skip(str(missing))
    assert image.shape == (240, 320, 3)
    # Far left red, far right green, near left blue, near right white.
    quarters = [image[90, 120], image[90, 200], image[150, 110], image[150, 210]]
    dominant = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]])
    np.testing.assert_allclose(quarters, dominant, atol=3)
    # The table lies around it.
    assert 120 < image[3, 3].min() < 250


def test_frame_and_holes_are_seen_and_the_relief_stays_as_fine_as_it_is(relief):
    box = slab()
    assert heights_above(relief, box) is relief.heights
    step = trimesh.creation.box(bounds=[[0, 0, -3], [4, 9, 2]])
    seen = heights_above(relief, trimesh.util.concatenate([trimesh.Trimesh(**vars(box)), step]))
    x = relief.grid.node_axes()[0]
    assert (seen[:, x < 3.9] == 2).all()
    assert (seen[:, x > 4.1] == 0).all()
    grid, heights = solid_heights(step, 0.1)
    assert (grid.shape, grid.origin) == ((90, 40), (0.0, 9.0))
    assert (heights == 2).all()


def test_a_solid_has_a_picture_without_a_relief(monkeypatch):
    monkeypatch.setattr(render, "_open_renderer", no_opengl)
    image, method = solid_picture(slab(), 0.25)
    assert (image.shape, method) == ((36, 48, 3), "hillshade")


def test_a_round_slab_has_a_round_shadow():
    disc = trimesh.creation.cylinder(radius=5, height=2)
    x = np.arange(-20, 20, 0.1)
    shadow = render._shadow(disc, x, x, 2.0, np.array([0.0, 0.0, 1.0]))
    dark = shadow < (1 + shadow.min()) / 2
    assert dark.sum() * 0.01 == pytest.approx(np.pi * 25, rel=0.03)
    assert not dark[np.hypot(*np.meshgrid(x, x)) > 5.5].any()
