import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.mesh import read_mesh

HEADER = """ply
format {encoding} 1.0
element vertex 6
property float x
property float y
property float z
element tristrips 1
property list int int vertex_indices
end_header
"""
VERTICES = np.array([[0, 0, 0], [1, 0, 1], [0, 1, 0], [1, 1, 1], [0, 2, 0], [1, 2, 2]], "f4")
STRIP = np.array([0, 1, 2, 3, 4, -1, 3, 5, 4], "i4")
FACES = {(0, 1, 2), (2, 1, 3), (2, 3, 4), (3, 5, 4)}


def as_set(mesh):
    """Faces by the places of their corners, rotated to start at the lowest."""
    found = set()
    for face in mesh.faces:
        ids = [int(np.flatnonzero((mesh.vertices[k] == VERTICES).all(axis=1))[0]) for k in face]
        turn = ids.index(min(ids))
        found.add(tuple(ids[turn:] + ids[:turn]))
    return found


def rotated(faces):
    return {tuple(f[f.index(min(f)) :] + f[: f.index(min(f))]) for f in faces}


@pytest.mark.parametrize("order", ["<", ">"])
def test_binary_strips_become_faces(tmp_path, order):
    encoding = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    body = VERTICES.astype(order + "f4").tobytes()
    body += np.array([len(STRIP)], order + "i4").tobytes() + STRIP.astype(order + "i4").tobytes()
    path = tmp_path / "strip.ply"
    path.write_bytes(HEADER.format(encoding=encoding).encode() + body)
    assert as_set(read_mesh(path)) == rotated(FACES)


def test_ascii_strips_become_faces(tmp_path):
    lines = [" ".join(f"{x:g}" for x in row) for row in VERTICES]
    lines.append(f"{len(STRIP)} " + " ".join(map(str, STRIP)))
    path = tmp_path / "strip.ply"
    path.write_text(HEADER.format(encoding="ascii") + "\n".join(lines) + "\n")
    assert as_set(read_mesh(path)) == rotated(FACES)


def test_a_strip_cut_short_is_refused(tmp_path):
    path = tmp_path / "strip.ply"
    path.write_bytes(HEADER.format(encoding="binary_little_endian").encode() + b"\0" * 40)
    with pytest.raises(InputError, match="cannot be read"):
        read_mesh(path)


def test_several_strips_in_one_file(tmp_path):
    lines = [" ".join(f"{x:g}" for x in row) for row in VERTICES]
    lines += ["5 0 1 2 3 4", "3 3 5 4"]
    path = tmp_path / "strips.ply"
    header = HEADER.format(encoding="ascii").replace("tristrips 1", "tristrips 2")
    path.write_text(header + "\n".join(lines) + "\n")
    assert as_set(read_mesh(path)) == rotated(FACES)


def test_elements_nobody_asked_for_are_refused(tmp_path):
    path = tmp_path / "strip.ply"
    header = HEADER.format(encoding="ascii").replace("element tri", "element edge 0\nelement tri")
    path.write_text(header)
    with pytest.raises(InputError, match="cannot be read"):
        read_mesh(path)
