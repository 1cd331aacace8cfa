"""Frames: a JSON header and arrays in one body, as the page takes them."""

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

KINDS = ("float32", "uint32", "uint8")
"""Of arrays; each has its typed array in a browser."""

_ALIGN = 8


def pack(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Put a header and arrays into one body.

    Parameters
    ----------
    header : mapping
        JSON values; `arrays` is added to it.
    arrays : mapping of ndarray
        Of one of `KINDS`.

    Returns
    -------
    bytes
        The header's length in four bytes, little-endian; the header, filled up with
        blanks so that what follows is aligned to eight bytes; the arrays, each aligned,
        little-endian, rows first.  Their offsets count from the first byte after the
        header.
    """
    listed, parts, offset = [], [], 0
    for name, array in arrays.items():
        if array.dtype.name not in KINDS:
            raise TypeError(f"{name} is {array.dtype}, which no frame holds")
        data = np.ascontiguousarray(array).astype(array.dtype.newbyteorder("<")).tobytes()
        listed.append(
            {"name": name, "dtype": array.dtype.name, "shape": array.shape, "offset": offset}
        )
        data += bytes(-len(data) % _ALIGN)
        parts.append(data)
        offset += len(data)
    text = json.dumps({**header, "arrays": listed}, allow_nan=False).encode()
    text += b" " * (-(4 + len(text)) % _ALIGN)
    return b"".join([struct.pack("<I", len(text)), text, *parts])


def unpack(body: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Take a frame apart again: its header and its arrays."""
    (length,) = struct.unpack_from("<I", body)
    header = json.loads(body[4 : 4 + length])
    arrays = {}
    for part in header.pop("arrays"):
        kind = np.dtype(part["dtype"]).newbyteorder("<")
        count = int(np.prod(part["shape"], dtype=np.int64))
        flat = np.frombuffer(body, kind, count, 4 + length + part["offset"])
        arrays[part["name"]] = flat.reshape(part["shape"])
    return header, arrays
