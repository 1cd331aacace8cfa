import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.layers.mesh import make_mesh, read_mesh


def ball():
    mesh = trimesh.creation.icosphere(subdivisions=2)
    return np.array(mesh.vertices), np.array(mesh.faces)


def volume(mesh):
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return np.einsum("fn,fn->", a, np.cross(b, c)) / 6


@pytest.mark.parametrize("suffix", ["stl", "obj", "ply", "off", "glb", "3mf"])
def test_every_format_comes_in_closed(tmp_path, suffix):
    vertices, faces = ball()
    path = tmp_path / f"ball.{suffix}"
    trimesh.Trimesh(vertices, faces, process=False).export(path)
    mesh = read_mesh(path)
    assert len(mesh.faces) == len(faces)
    assert len(mesh.vertices) == len(vertices)
    assert mesh.notes == ()
    assert volume(mesh) == pytest.approx(volume(make_mesh(vertices, faces)), rel=1e-5)


def test_inside_out_is_turned_and_said():
    vertices, faces = ball()
    mesh = make_mesh(vertices, faces[:, ::-1])
    assert volume(mesh) > 0
    assert any("inside out" in note for note in mesh.notes)


def test_faces_wound_against_their_neighbours_are_turned():
    vertices, faces = ball()
    mixed = faces.copy()
    mixed[::3] = mixed[::3, ::-1]
    mesh = make_mesh(vertices, mixed)
    assert volume(mesh) == pytest.approx(volume(make_mesh(vertices, faces)))
    assert any("against their neighbours" in note for note in mesh.notes)


def test_only_the_body_that_is_inside_out_is_turned():
    vertices, faces = ball()
    both = np.concatenate([vertices, vertices + 5])
    mesh = make_mesh(both, np.concatenate([faces, faces[:, ::-1] + len(vertices)]))
    assert volume(mesh) == pytest.approx(2 * volume(make_mesh(vertices, faces)))


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_size_does_not_matter(scale):
    vertices, faces = ball()
    loose = vertices[faces].reshape(-1, 3) * scale
    mesh = make_mesh(loose, np.arange(len(loose)).reshape(-1, 3))
    assert len(mesh.vertices) == len(vertices)
    assert mesh.notes == ()


def test_open_and_odd_surfaces_are_told():
    vertices, faces = ball()
    notes = make_mesh(vertices, np.concatenate([faces[1:], faces[5:6], [[3, 3, 7]]])).notes
    assert any("open surface: 3 edges" in note for note in notes)
    assert any("doubled" in note for note in notes)
    assert any("without area" in note for note in notes)


def test_three_faces_on_an_edge_are_told():
    vertices, faces = ball()
    extra = np.concatenate([vertices, [[3.0, 3, 3]]])
    fin = [[faces[0, 0], faces[0, 1], len(vertices)]]
    notes = make_mesh(extra, np.concatenate([faces, fin])).notes
    assert any("not a manifold: 1 edges" in note for note in notes)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda v, f: (v, f[:0]), "no faces"),
        (lambda v, f: (v * np.where(np.arange(len(v)) == 7, np.nan, 1)[:, None], f), "NaN"),
        (lambda v, f: (v * np.where(np.arange(len(v)) == 7, np.inf, 1)[:, None], f), "NaN"),
        (lambda v, f: (v, f + 5), "do not exist"),
        (lambda v, f: (v * 0, f), "single point"),
        (lambda v, f: (v * [1, 0, 0], f), "degenerate"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_broken_models_are_refused(spoil, words):
    with pytest.raises(InputError, match=words):
        make_mesh(*spoil(*ball()))


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.stl", b"", "empty"),
        ("a.stl", b"this is a letter, not a model", "cannot be read|no faces"),
        ("a.obj", b"v 0 0 0\n", "no faces|cannot be read"),
        ("a.ply", b"ply\nformat ascii 1.0\nelement vertex 5\nend_header\n", "cannot be read|no fa"),
        ("a.glb", b"glTF\x02\x00\x00\x00nonsense", "cannot be read"),
        ("a.3mf", b"PK\x03\x04nonsense", "cannot be read"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n", "cannot be read|no faces"),
        ("a.txt", b"hello", "not a model file"),
    ],
)
def test_files_that_are_no_models_are_refused(tmp_path, name, content, words):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=words):
        read_mesh(tmp_path / name)


def test_a_missing_file_is_told_with_its_neighbour(tmp_path):
    (tmp_path / "horse.ply").write_bytes(b"x")
    with pytest.raises(InputError, match=r"did you mean horse\.ply"):
        read_mesh(tmp_path / "hose.ply")


def test_a_folder_is_no_model(tmp_path):
    with pytest.raises(InputError, match="folder"):
        read_mesh(tmp_path)
