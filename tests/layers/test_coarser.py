import numpy as np
import trimesh

from relieffab.layers.coarser import MORE, coarser


def test_a_light_mesh_stays_itself(model):
    assert coarser(model, len(model.faces)) is model


def test_fewer_triangles_keep_form_and_place(model):
    fewer = coarser(model, 1000)
    assert len(fewer.faces) <= MORE * 1000
    assert (fewer.name, fewer.notes, fewer.usual_up) == (model.name, model.notes, model.usual_up)
    np.testing.assert_allclose(
        np.ptp(fewer.vertices, axis=0), np.ptp(model.vertices, axis=0), rtol=0.02
    )
    volumes = [trimesh.Trimesh(m.vertices, m.faces, process=False).volume for m in (model, fewer)]
    assert abs(volumes[1] / volumes[0] - 1) < 0.01


def test_few_enough_are_left_whatever_the_mesh(model):
    assert len(coarser(model, 60).faces) <= MORE * 60
