"""A panel photographed: its real solid, tilted on a table, drawn by pyrender.

The stone's shading is the hillshade of the relief laid over the face as a texture,
because it knows shadows and soft light; OpenGL gives the perspective, what hides
what, and the slab's sides.
"""

import os
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from relieffab.errors import RelieffabError
from relieffab.grid import Grid
from relieffab.layers.raster import rasterise
from relieffab.picture.stone import BOUNCE, GAMMA, KEY, LIGHT, SKY, unit_light
from relieffab.picture.texture import Texture, plain_colour

Floats = NDArray[np.float64]

# How the panel is turned from the full view, degrees; and the camera's field of view.
TILT, SWING, FIELD_OF_VIEW = 27.0, -10.0, 24.0
# Share of the picture that the panel may fill.
FILL = 0.93
TABLE = (0.60, 0.57, 0.53)
CLAMP_TO_EDGE = 33071
# Z of the normal below which a face is a side.
UPRIGHT = 1e-3


class OpenGLMissingError(RelieffabError):
    """There is no OpenGL to draw with here."""


class TriangleMesh(Protocol):
    """Whatever has the vertices and faces of a solid."""

    @property
    def vertices(self) -> Floats:
        """(v, 3), mm."""

    @property
    def faces(self) -> NDArray[np.integer]:
        """(f, 3), counter-clockwise seen from outside."""


def _open_renderer(width: int, height: int) -> Any:
    """Open pyrender off screen, through EGL unless the environment says otherwise."""
    os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
    try:
        from OpenGL.error import Error as OpenGLError
        from pyrender import OffscreenRenderer
    except (ImportError, AttributeError, OSError) as error:
        raise OpenGLMissingError(
            "pyrender cannot be loaded", found=str(error), hint="install libegl1 and libgl1"
        ) from error
    try:
        return OffscreenRenderer(width, height)
    # What pyrender's EGL layer raises, by its source, where there is no usable device.
    except (
        OpenGLError,
        ImportError,
        AssertionError,
        IndexError,
        ValueError,
        RuntimeError,
    ) as error:
        raise OpenGLMissingError(
            "OpenGL cannot be opened", found=str(error), hint="install libgl1-mesa-dri"
        ) from error


def camera_pose(low: Floats, high: Floats, aspect: float) -> Floats:
    """Place a camera so that a box just fits the picture.

    Parameters
    ----------
    low, high : (3,) ndarray
        Corners of the box, mm.
    aspect : float
        Width of the picture over its height.

    Returns
    -------
    ndarray (4, 4)
        Camera to panel coordinates; the camera looks along its own -Z.
    """
    tilt, swing = np.radians(TILT), np.radians(SWING)
    back = np.array([np.sin(swing) * np.cos(tilt), -np.sin(tilt), np.cos(swing) * np.cos(tilt)])
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right), back], axis=1)
    half = (high - low) / 2
    corners = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) * half
    x, y, z = (corners @ axes).T
    reach = FILL * np.tan(np.radians(FIELD_OF_VIEW) / 2)
    distance = np.max(z + np.maximum(np.abs(x) / aspect, np.abs(y)) / reach)
    pose = np.eye(4)
    pose[:3, :3] = axes
    pose[:3, 3] = (low + high) / 2 + distance * back
    return pose


def side_faces(vertices: Floats, faces: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Which faces are the slab's sides, its holes' or its back, (f,).

    They stand upright or face down; in a relief only a wall does, which never
    reaches the back.
    """
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    upright = normals[:, 2] < UPRIGHT * np.linalg.norm(normals, axis=1)
    low = vertices[:, 2].min()
    span = float(np.ptp(vertices[:, 2]))
    return np.asarray(upright & (corners[:, :, 2].min(axis=1) < low + 1e-4 * span))


def _texture(image: NDArray[np.uint8]) -> Any:
    from pyrender import MetallicRoughnessMaterial, Sampler, Texture

    sampler = Sampler(wrapS=CLAMP_TO_EDGE, wrapT=CLAMP_TO_EDGE)
    # Four bytes a pixel: OpenGL takes rows of three amiss unless they are whole words.
    opaque = np.dstack([image, np.full(image.shape[:2], 255, np.uint8)])
    texture = Texture(source=np.ascontiguousarray(opaque), source_channels="RGBA", sampler=sampler)
    return MetallicRoughnessMaterial(baseColorTexture=texture, doubleSided=True)


def _face(panel: TriangleMesh, faces: NDArray[np.integer], image: Any, grid: Grid) -> Any:
    """Lay the texture over the carved face."""
    from pyrender import Primitive

    row, col = grid.to_index(panel.vertices[:, 0], panel.vertices[:, 1])
    where = np.stack([col / grid.cols, 1 - row / grid.rows], axis=1)
    return Primitive(
        positions=panel.vertices.astype(np.float32),
        indices=faces.astype(np.uint32),
        texcoord_0=where.astype(np.float32),
        material=_texture(image),
    )


def _sides(panel: TriangleMesh, faces: NDArray[np.integer], light: Floats, texture: Texture) -> Any:
    """Colour the slab's sides, each in one shade."""
    from pyrender import MetallicRoughnessMaterial, Primitive

    corners = panel.vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    grey = KEY * np.maximum(normals @ light, 0) + SKY * (1 + normals[:, 2]) / 2 + 2 * BOUNCE
    colours = np.clip(grey[:, None] * plain_colour(texture), 0, 1) ** (1 / GAMMA)
    alpha = np.ones((len(colours), 1))
    return Primitive(
        positions=corners.reshape(-1, 3).astype(np.float32),
        color_0=np.repeat(np.hstack([colours, alpha]), 3, axis=0).astype(np.float32),
        material=MetallicRoughnessMaterial(doubleSided=True),
    )


def _shadow(panel: TriangleMesh, x: Floats, y: Floats, thick: float, light: Floats) -> Floats:
    """Darken a table under a slab's soft shadow, (y, x): 1 where none falls."""
    step = x[1] - x[0]
    grid = Grid(len(y), len(x), step, (x[0] - step / 2, y[-1] + step / 2))
    plan = rasterise(panel.vertices, panel.faces, grid).mask.astype(float)[::-1]
    shadow = np.ones_like(plan)
    # It is swept from the slab's foot to its upper edge's.
    for share in np.linspace(0, 1, 16):
        dx, dy = -share * thick * light[:2] / light[2] / step
        soft = ndimage.gaussian_filter(plan, thick * (0.06 + 0.18 * share) / step)
        shadow = np.minimum(shadow, 1 - 0.62 * ndimage.shift(soft, (dy, dx), order=1))
    return shadow


def _table(panel: TriangleMesh, low: Floats, high: Floats, light: Floats) -> Any:
    """Lay a plain table below, the slab's soft shadow on it."""
    from pyrender import Primitive

    size, thick = float((high - low)[:2].max()), float(high[2] - low[2])
    step, half = 5 * size / 1024, 2.5 * size
    x, y = (np.arange(at - half, at + half, step) for at in ((low + high) / 2)[:2].tolist())
    shadow = _shadow(panel, x, y, thick, light)
    far = np.hypot(*np.meshgrid((x - x.mean()) / size, (y - y.mean()) / size))
    grey = shadow * np.maximum(1.08 - 0.22 * far**2, 0.4)
    image = np.clip(grey[..., None] * TABLE, 0, 1) ** (1 / GAMMA)
    start, end = (x[0], y[0]), (x[-1], y[-1])
    corners = [start, (end[0], start[1]), end, (start[0], end[1])]
    below = float(low[2]) - 0.002 * thick
    return Primitive(
        positions=np.array([(a, b, below) for a, b in corners], np.float32),
        indices=np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
        texcoord_0=np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32),
        material=_texture(np.rint(255 * image[::-1]).astype(np.uint8)),
    )


def render_panel(
    panel: TriangleMesh,
    face: NDArray[np.uint8],
    grid: Grid,
    *,
    width: int = 1600,
    light: ArrayLike = LIGHT,
    texture: Texture = "stone",
) -> NDArray[np.uint8]:
    """Draw a panel in perspective.

    Parameters
    ----------
    panel : TriangleMesh
        Closed, the face at Z0, mm.
    face : (rows, cols, 3) ndarray of uint8
        Picture of the relief, seen straight on.
    grid : Grid
        Where that picture lies on the panel.
    width : int
        Of the picture, pixels; its height is three quarters of that.
    light : (3,) array_like
        Towards the key light; the same as the face's.
    texture : {'stone', 'wood'}
        The face's, for the slab's sides.

    Returns
    -------
    ndarray (3/4 width, width, 3) of uint8

    Raises
    ------
    OpenGLMissingError
        Where pyrender finds no OpenGL.
    """
    height = width * 3 // 4
    renderer = _open_renderer(width, height)
    try:
        from pyrender import Mesh, PerspectiveCamera, RenderFlags, Scene

        low, high = panel.vertices.min(axis=0), panel.vertices.max(axis=0)
        side = side_faces(panel.vertices, panel.faces)
        towards = unit_light(light)
        pose = camera_pose(low, high, width / height)
        scene = Scene(bg_color=(*TABLE, 1.0))
        parts = [
            _face(panel, panel.faces[~side], face, grid),
            _sides(panel, panel.faces[side], towards, texture),
            _table(panel, low, high, towards),
        ]
        for part in parts:
            scene.add(Mesh([part]))
        span = float(np.linalg.norm(high - low))
        distance = float(np.linalg.norm(pose[:3, 3] - (low + high) / 2))
        camera = PerspectiveCamera(
            yfov=np.radians(FIELD_OF_VIEW),
            aspectRatio=width / height,
            znear=max(0.1 * span, distance - 2 * span),
            zfar=distance + 6 * span,
        )
        scene.add(camera, pose=pose)
        colour, _ = renderer.render(scene, flags=RenderFlags.FLAT)
    finally:
        renderer.delete()
    return np.array(colour[..., :3], dtype=np.uint8)
