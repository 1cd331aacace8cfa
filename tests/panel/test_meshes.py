import json
import struct

import numpy as np
import pytest
import trimesh

from relieffab.panel.meshes import to_glb, to_metres, to_obj


@pytest.fixture
def box():
    mesh = trimesh.creation.box((1, 2, 3))
    return np.array(mesh.vertices), np.array(mesh.faces)


def test_metres_and_y_up():
    np.testing.assert_allclose(to_metres(np.array([[10.0, 20, 30]])), [[0.01, 0.03, -0.02]])


def test_turning_keeps_the_outside_outside(box):
    vertices, faces = box
    turned = trimesh.Trimesh(to_metres(vertices), faces, process=False)
    assert turned.volume == pytest.approx(6e-9)


@pytest.mark.parametrize("name", ["box", "a longer name", 'sch"räg'])
def test_glb_chunks_are_whole_and_aligned(box, name):
    data = to_glb(*box, name)
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert (size % 4, kind) == (0, b"JSON")
    scene = json.loads(data[20 : 20 + size])
    rest, kind = struct.unpack_from("<I4s", data, 20 + size)
    assert (rest, kind) == (scene["buffers"][0]["byteLength"], b"BIN\0")
    assert 28 + size + rest == len(data)
    assert scene["nodes"] == [{"mesh": 0, "name": name}]
    assert scene["accessors"][0]["max"] == [0.5, 1.0, 1.5]


def test_an_object_file_is_one_object_whatever_its_name(box):
    lines = to_obj(*box, "two\nlines").decode().splitlines()
    assert [line.split()[0] for line in lines] == ["#", "o", *["v"] * 8, *["f"] * 12]
