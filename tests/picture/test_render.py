"""The panel in perspective; drawn where there is OpenGL, and plainly refused where not."""

from types import SimpleNamespace

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.picture import OpenGLMissingError, panel_picture, render
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


def test_panel_is_drawn_with_its_face_the_right_way_round(relief):
    box = slab()
    face = np.zeros((48, 64, 3), np.uint8)
    face[:24, :32, 0] = face[:24, 32:, 1] = face[24:, :32, 2] = 255
    face[24:, 32:] = 255
    try:
        image = render.render_panel(box, face, relief.grid, width=320)
    except OpenGLMissingError as missing:
        pytest.skip(str(missing))
    assert image.shape == (240, 320, 3)
    # Far left red, far right green, near left blue, near right white.
    quarters = [image[90, 120], image[90, 200], image[150, 110], image[150, 210]]
    dominant = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]])
    np.testing.assert_allclose(quarters, dominant, atol=3)
    # The table lies around it.
    assert 120 < image[3, 3].min() < 250
