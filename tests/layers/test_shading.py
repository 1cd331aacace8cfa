import numpy as np
import pytest
import trimesh

from relieffab.grid import Grid
from relieffab.layers.raster import rasterise
from relieffab.layers.shading import default_lights, lambert, pixel_normals, smoothing_groups

GRID = Grid(90, 90, 0.1, (-4.5, 4.5))


def normals_of(mesh):
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    raster = rasterise(vertices, faces, GRID)
    return raster, pixel_normals(raster, vertices, faces, GRID)


def test_normals_of_a_sphere():
    raster, normals = normals_of(trimesh.creation.icosphere(subdivisions=5, radius=4))
    i, j = np.indices(GRID.shape)
    x, y = GRID.to_xy(i + 0.5, j + 0.5)
    inner = x**2 + y**2 < 3.8**2
    z = np.sqrt(np.maximum(16 - x**2 - y**2, 0))
    true = np.stack([x, y, z], axis=2) / 4
    angle = np.degrees(np.arccos(np.clip((normals * true).sum(axis=2), -1, 1)))
    assert raster.mask[inner].all()
    assert angle[inner].max() < 1.0


def test_a_crease_stays_sharp_and_a_smooth_edge_does_not():
    box = trimesh.creation.box((4, 4, 4))
    turned = (
        np.array(box.vertices) @ trimesh.transformations.rotation_matrix(0.7, [0, 1, 0])[:3, :3]
    )
    raster = rasterise(turned, box.faces, GRID)
    normals = pixel_normals(raster, turned, np.array(box.faces), GRID)
    found = np.unique(np.round(normals[raster.mask], 6), axis=0)
    assert len(found) == 2
    _, count = smoothing_groups(turned, np.array(box.faces), 40.0)
    assert count == 24
    _, count = smoothing_groups(turned, np.array(box.faces), 100.0)
    assert count == 8


def test_backs_are_turned_to_the_viewer():
    ball = trimesh.creation.icosphere(subdivisions=3, radius=4)
    raster = rasterise(np.array(ball.vertices), np.array(ball.faces)[:, ::-1], GRID)
    normals = pixel_normals(raster, np.array(ball.vertices), np.array(ball.faces)[:, ::-1], GRID)
    assert (normals[..., 2] >= 0).all()


def test_lambert_is_the_cosine_and_never_negative():
    lights = default_lights()
    normals = np.array([[[0.0, 0, 1], [1.0, 0, 0]]])
    shading = lambert(normals, lights)
    assert shading[:, 0, 0] == pytest.approx(1 / np.sqrt(3))
    assert shading[0, 0, 1] == 0
    assert shading[1, 0, 1] == pytest.approx(1 / np.sqrt(3))
