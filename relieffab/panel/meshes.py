"""A welded mesh as the bytes of an STL, PLY, OBJ or GLB file."""

import json
import struct

import numpy as np
import trimesh

from relieffab.panel.model import Floats, Ints

# A matt limestone, linear: glTF's own default is polished metal.
STONE = {
    "name": "stone",
    "pbrMetallicRoughness": {
        "baseColorFactor": [0.82, 0.67, 0.47, 1.0],
        "metallicFactor": 0.0,
        "roughnessFactor": 0.9,
    },
}
FLOAT, UNSIGNED_INT, ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 5126, 5125, 34962, 34963


def to_binary(vertices: Floats, faces: Ints, kind: str) -> bytes:
    """Pack a mesh into a binary STL or PLY, single precision.

    Parameters
    ----------
    vertices : (v, 3) ndarray
    faces : (f, 3) ndarray of int
    kind : str
        'stl' or 'ply'.
    """
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    return bytes(mesh.export(file_type=kind))


def to_obj(vertices: Floats, faces: Ints, name: str) -> bytes:
    """Write a mesh as a Wavefront OBJ; nine digits hold single precision exactly.

    Parameters
    ----------
    vertices : (v, 3) ndarray
    faces : (f, 3) ndarray of int
    name : str
        The object's.
    """
    name = "".join(letter if letter.isprintable() else "?" for letter in name)
    places = "v %.9g %.9g %.9g\n" * len(vertices) % tuple(vertices.ravel().tolist())
    corners = "f %d %d %d\n" * len(faces) % tuple((faces + 1).ravel().tolist())
    return f"# relieffab: millimetres, Z up\no {name}\n{places}{corners}".encode()


def to_metres(vertices: Floats) -> Floats:
    """Turn mm with Z up into metres with Y up (glTF 2.0, 3.4): the face looks along +Y.

    Parameters
    ----------
    vertices : (v, 3) ndarray
    """
    x, y, z = vertices.T
    return np.stack([x, z, -y], axis=1) / 1000


def to_glb(vertices: Floats, faces: Ints, name: str) -> bytes:
    """Pack a mesh into a binary glTF 2.0 without normals, so that triangles look flat.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        Metres, Y up, single precision numbers.
    faces : (f, 3) ndarray of int
    name : str
        The mesh's and its node's.
    """
    places = vertices.astype("<f4")
    corners = faces.astype("<u4")
    low, high = (edge.astype(float).tolist() for edge in (places.min(axis=0), places.max(axis=0)))
    views = [
        {"buffer": 0, "byteOffset": 0, "byteLength": places.nbytes, "target": ARRAY_BUFFER},
        {
            "buffer": 0,
            "byteOffset": places.nbytes,
            "byteLength": corners.nbytes,
            "target": ELEMENT_ARRAY_BUFFER,
        },
    ]
    kind = {"componentType": FLOAT, "count": len(places), "type": "VEC3", "min": low, "max": high}
    count = {"componentType": UNSIGNED_INT, "count": corners.size, "type": "SCALAR"}
    shape = {"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}
    scene = {
        "asset": {"version": "2.0", "generator": "relieffab"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"name": name, "primitives": [shape]}],
        "materials": [STONE],
        "accessors": [{"bufferView": 0, **kind}, {"bufferView": 1, **count}],
        "bufferViews": views,
        "buffers": [{"byteLength": places.nbytes + corners.nbytes}],
    }
    text = json.dumps(scene, separators=(",", ":")).encode()
    return _glb(text + b" " * (-len(text) % 4), places.tobytes() + corners.tobytes())


def _glb(text: bytes, binary: bytes) -> bytes:
    """Join the two chunks of a GLB, each a multiple of four bytes (glTF 2.0, 4.4)."""
    chunks = b"".join(
        struct.pack("<I4s", len(content), kind) + content
        for kind, content in ((b"JSON", text), (b"BIN\0", binary))
    )
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
