"""PLY files whose faces are triangle strips, which the usual readers take for empty."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_TYPES = {
    "char": "i1",
    "int8": "i1",
    "uchar": "u1",
    "uint8": "u1",
    "short": "i2",
    "int16": "i2",
    "ushort": "u2",
    "uint16": "u2",
    "int": "i4",
    "int32": "i4",
    "uint": "u4",
    "uint32": "u4",
    "float": "f4",
    "float32": "f4",
    "double": "f8",
    "float64": "f8",
}
_HEADER_LIMIT = 65536


def has_tristrips(path: Path) -> bool:
    """Tell whether a PLY file keeps its faces as `element tristrips`."""
    with path.open("rb") as file:
        head = file.read(_HEADER_LIMIT)
    return b"element tristrips" in head.partition(b"end_header")[0]


def read_tristrips(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read vertices and the faces that the strips stand for.

    Returns
    -------
    vertices : (v, 3) ndarray
    faces : (f, 3) ndarray of int

    Raises
    ------
    ValueError
        If the file does not hold what its header promises.
    """
    header, _, body = path.read_bytes().partition(b"end_header")
    body = body[body.index(b"\n") + 1 :]
    lines = [line.split() for line in header.decode("ascii").splitlines()]
    encoding = next((line[1] for line in lines if line and line[0] == "format"), "none")
    elements = [(line[1], int(line[2])) for line in lines if line and line[0] == "element"]
    if [name for name, _ in elements] != ["vertex", "tristrips"]:
        raise ValueError(f"elements other than vertex and tristrips: {elements}")
    (_, vertex_count), (_, lists) = elements
    fields = _vertex_fields(lines)
    if encoding == "ascii":
        words = body.split()
        rows = np.array(words[: vertex_count * len(fields)], float).reshape(vertex_count, -1)
        names = [name for name, _ in fields]
        vertices = rows[:, [names.index(axis) for axis in "xyz"]]
        numbers = np.array(words[vertex_count * len(fields) :], np.int64)
        strips, at = [], 0
        for _ in range(lists):
            count = int(numbers[at])
            strips.append(_whole(numbers[at + 1 : at + 1 + count], count))
            at += 1 + count
    else:
        order = {"binary_little_endian": "<", "binary_big_endian": ">"}[encoding]
        record = np.dtype([(name, order + kind) for name, kind in fields])
        table = np.frombuffer(body, record, vertex_count)
        vertices = np.stack([table[axis].astype(float) for axis in "xyz"], axis=1)
        count_type, item_type = (np.dtype(order + kind) for kind in _strip_types(lines))
        strips, at = [], record.itemsize * vertex_count
        for _ in range(lists):
            count = int(np.frombuffer(body, count_type, 1, at)[0])
            at += count_type.itemsize
            strips.append(np.frombuffer(body, item_type, count, at).astype(np.int64))
            at += item_type.itemsize * count
    joined = [part for strip in strips for part in (strip, np.array([-1]))]
    return vertices, unroll(np.concatenate(joined))


def _whole(numbers: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    if len(numbers) != count:
        raise ValueError(f"a strip of {count} indices ends after {len(numbers)}")
    return numbers


def _vertex_fields(lines: list[list[str]]) -> list[tuple[str, str]]:
    start = next(i for i, line in enumerate(lines) if line[:2] == ["element", "vertex"])
    fields = []
    for line in lines[start + 1 :]:
        if not line or line[0] != "property":
            break
        fields.append((line[2], _TYPES[line[1]]))
    return fields


def _strip_types(lines: list[list[str]]) -> tuple[str, str]:
    start = next(i for i, line in enumerate(lines) if line[:2] == ["element", "tristrips"])
    _, _, count_type, item_type, _ = lines[start + 1]
    return _TYPES[count_type], _TYPES[item_type]


def unroll(strip: NDArray[np.int64]) -> NDArray[np.int64]:
    """Turn strips (joined by -1) into triangles; every second one is wound back.

    Examples
    --------
    >>> unroll(np.array([0, 1, 2, 3, -1, 4, 5, 6])).tolist()
    [[0, 1, 2], [2, 1, 3], [4, 5, 6]]
    """
    faces = np.stack([strip[:-2], strip[1:-1], strip[2:]], axis=1)
    index = np.arange(len(strip))
    start = np.maximum.accumulate(np.where(strip < 0, index + 1, 0))[:-2]
    odd = (index[:-2] - start) % 2 == 1
    faces[odd] = faces[odd][:, [1, 0, 2]]
    return faces[(faces >= 0).all(axis=1)]
