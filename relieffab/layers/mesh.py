"""Mesh: read a file, check it, repair what can be repaired, say what was done."""

import struct
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from relieffab.errors import InputError, suggest
from relieffab.layers.tristrips import has_tristrips, read_tristrips

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Formats read, each with the axis that its files usually have up.
USUAL_UP = {".stl": "z", ".obj": "y", ".ply": None, ".off": "y", ".glb": "y", ".3mf": "z"}

# What the loaders raise on broken files; anything else is a fault of ours.
_LOADER_FAULTS = (
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    AttributeError,
    NotImplementedError,
    EOFError,
    SyntaxError,
    OSError,
    ImportError,
    struct.error,
    zipfile.BadZipFile,
)


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh fit to be looked at; arrays are read-only.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        In the model's own units.
    faces : (f, 3) ndarray of int
        Closed bodies are oriented outward.
    name : str
    notes : tuple of str
        What was found and what was done about it.
    usual_up : {'y', 'z'} or None
        The axis that files of this format usually have up.
    """

    vertices: Floats
    faces: Ints
    name: str
    notes: tuple[str, ...] = ()
    usual_up: str | None = None

    def __post_init__(self) -> None:
        self.vertices.flags.writeable = False
        self.faces.flags.writeable = False


def read_mesh(path: str | Path) -> Mesh:
    """Read a model from a file.

    Parameters
    ----------
    path : str or Path
        STL, OBJ, PLY (triangle strips too), OFF, GLB or 3MF.

    Returns
    -------
    Mesh

    Raises
    ------
    InputError
        If the file is missing, unreadable or holds nothing that can be carved.
    """
    path = Path(path)
    where = str(path)
    if path.is_dir():
        raise InputError("the model is a folder", expected="a model file", where=where)
    if not path.is_file():
        raise InputError("there is no such model file", where=where, hint=_nearest(path))
    suffix = path.suffix.lower()
    if suffix not in USUAL_UP:
        raise InputError(
            "this is not a model file",
            expected=" ".join(USUAL_UP) + ", a picture, an SVG or a font",
            found=repr(path.suffix),
            where=where,
        )
    if path.stat().st_size == 0:
        raise InputError("the model file is empty", found="0 bytes", where=where)
    try:
        vertices, faces = _load(path, suffix)
    except _LOADER_FAULTS as fault:
        raise InputError(
            "the model file cannot be read",
            expected=f"a sound {suffix[1:].upper()} file",
            found=f"{type(fault).__name__}: {fault}".splitlines()[0][:200],
            where=where,
        ) from fault
    return make_mesh(vertices, faces, name=path.name, usual_up=USUAL_UP[suffix])


def _nearest(path: Path) -> str:
    """Name the model beside it that was probably meant."""
    beside = path.parent.iterdir() if path.parent.is_dir() else ()
    names = [p.name for p in beside if p.suffix.lower() in USUAL_UP and p.is_file()]
    meant = suggest(path.name, names)
    return meant if meant.startswith("did you") else "check the path"


def _load(path: Path, suffix: str) -> tuple[Floats, Ints]:
    if suffix == ".ply" and has_tristrips(path):
        return read_tristrips(path)
    import trimesh

    scene = trimesh.load_scene(path, process=False)
    mesh = scene.to_mesh()
    return np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64)


def make_mesh(
    vertices: Floats,
    faces: NDArray[np.integer],
    *,
    name: str = "model",
    usual_up: str | None = None,
) -> Mesh:
    """Check and repair raw triangles.

    Parameters
    ----------
    vertices : (v, 3) ndarray
    faces : (f, 3) ndarray of int
    name : str
    usual_up : {'y', 'z'}, optional

    Returns
    -------
    Mesh
        Coincident vertices merged, degenerate and doubled triangles dropped,
        closed bodies turned outward.

    Raises
    ------
    InputError
        If there are no faces, NaN or infinite vertices, indices out of range, or
        no volume and no surface to speak of.
    """
    vertices = np.array(vertices, np.float64)
    triangles: Ints = np.array(faces, np.int64)
    _refuse_broken(vertices, triangles, name)
    notes: list[str] = []
    vertices, triangles = _merge(vertices, triangles)
    triangles = _drop_bad(triangles, vertices, notes)
    if len(triangles) == 0:
        raise InputError("every triangle of the model is degenerate", where=name)
    triangles = _orient(vertices, triangles, notes)
    return Mesh(vertices, triangles, name, tuple(notes), usual_up)


def _refuse_broken(vertices: Floats, faces: Ints, name: str) -> None:
    if len(faces) == 0 or len(vertices) == 0:
        raise InputError(
            "the model has no faces",
            expected="a surface of triangles",
            found=f"{len(vertices)} vertices, {len(faces)} faces",
            where=name,
            hint="export the surface, not points or curves",
        )
    bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(bad):
        raise InputError(
            "the model has vertices that are NaN or infinite",
            found=f"{len(bad)} of {len(vertices)}, the first is vertex {bad[0]}",
            where=name,
            hint="repair the model where it was made",
        )
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise InputError(
            "faces point to vertices that do not exist",
            expected=f"indices from 0 to {len(vertices) - 1}",
            found=f"{faces.min()} to {faces.max()}",
            where=name,
        )
    with np.errstate(over="ignore"):
        extent = float(np.ptp(vertices, axis=0).max())
    if not 0 < extent < np.inf:
        raise InputError("the model is a single point, or endless", found=f"{extent}", where=name)


def _merge(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """Give coincident corners one vertex: seams of textures and STL's loose triangles."""
    low = vertices.min(axis=0)
    key = np.round((vertices - low) / np.ptp(vertices, axis=0).max() * 2.0**30).astype(np.int64)
    code = (key[:, 0] * 2654435761 + key[:, 1]) * 2654435761 + key[:, 2]
    order = np.lexsort((key[:, 2], key[:, 1], key[:, 0], code))
    new = np.concatenate([[True], (np.diff(key[order], axis=0) != 0).any(axis=1)])
    merged = np.empty(len(vertices), np.int64)
    merged[order] = np.cumsum(new) - 1
    used, inverse = np.unique(merged[faces], return_inverse=True)
    return vertices[order[new]][used], inverse.reshape(faces.shape)


def _drop_bad(faces: Ints, vertices: Floats, notes: list[str]) -> Ints:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    size = np.ptp(vertices, axis=0).max()
    area = np.linalg.norm(np.cross((b - a) / size, (c - a) / size), axis=1)
    sound = area > 1e-18
    if not sound.all():
        notes.append(f"dropped {int((~sound).sum())} triangles without area")
    faces = faces[sound]
    ordered = np.sort(faces, axis=1)
    _, first = np.unique(ordered, axis=0, return_index=True)
    if len(first) < len(faces):
        notes.append(f"dropped {len(faces) - len(first)} doubled triangles")
        faces = faces[np.sort(first)]
    return faces


def _orient(vertices: Floats, faces: Ints, notes: list[str]) -> Ints:
    """Make neighbours agree on a winding, then turn closed bodies outward."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    forward = (faces < faces[:, [1, 2, 0]]).ravel()
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = (np.diff(edges[order], axis=0) == 0).all(axis=1)
    start = np.flatnonzero(np.concatenate([[True], ~same]))
    uses = np.diff(np.concatenate([start, [len(order)]]))
    if (uses == 1).any():
        notes.append(f"open surface: {int((uses == 1).sum())} edges with one face")
    if (uses > 2).any():
        notes.append(f"not a manifold: {int((uses > 2).sum())} edges with three or more faces")
    pair = start[uses == 2]
    one, two = order[pair], order[pair + 1]
    body, flip = _agree(len(faces), one // 3, two // 3, forward[one] == forward[two])
    if flip.any():
        notes.append(f"turned {int(flip.sum())} triangles wound against their neighbours")
        faces = np.where(flip[:, None], faces[:, ::-1], faces)
    centre = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, k]] - centre for k in range(3))
    volume = np.bincount(body, np.einsum("fn,fn->f", a, np.cross(b, c)), body.max() + 1)
    edge_body = body[order[start] // 3]
    open_edges = np.bincount(edge_body[uses == 1], minlength=body.max() + 1)
    inside_out = (volume < 0) & (open_edges == 0)
    if inside_out.any():
        notes.append(f"inside out: turned {int(inside_out.sum())} closed bodies outward")
        faces = np.where(inside_out[body][:, None], faces[:, ::-1], faces)
    return np.ascontiguousarray(faces)


def _agree(
    count: int, one: Ints, two: Ints, against: NDArray[np.bool_]
) -> tuple[Ints, NDArray[np.bool_]]:
    """Label connected bodies and find the faces to flip so that neighbours agree.

    The graph holds every face twice, as it is and flipped; an edge whose faces
    agree joins like to like, one whose faces disagree joins each to the other's
    flipped twin.  A face whose label differs from its body's first goes over.
    """
    ends_one = np.concatenate([one, one + count])
    ends_two = np.concatenate([two + count * against, two + count * ~against])
    graph = coo_array(
        (np.ones(len(ends_one), np.int8), (ends_one, ends_two)), shape=(2 * count,) * 2
    )
    _, side = connected_components(graph, directed=False)
    plain = coo_array((np.ones(len(one), np.int8), (one, two)), shape=(count, count))
    bodies, body = connected_components(plain, directed=False)
    first = np.full(bodies, -1, np.int64)
    first[body[::-1]] = np.arange(count)[::-1]
    flip = side[:count] != side[first[body]]
    mostly = np.bincount(body, flip, bodies) > 0.5 * np.bincount(body, minlength=bodies)
    one_sided = side[:count] == side[count:]  # a Moebius band agrees with its own flip
    return body.astype(np.int64), (flip ^ mostly[body]) & ~one_sided
