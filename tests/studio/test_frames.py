import json
import struct

import numpy as np
import pytest

from relieffab.studio.frames import pack, unpack


def test_what_is_packed_is_unpacked():
    arrays = {
        "heights": np.linspace(-1, 0, 6, dtype=np.float32).reshape(2, 3),
        "mask": np.array([1, 0, 1], np.uint8),
        "indices": np.array([[0, 1, 2**32 - 1]], np.uint32),
        "none": np.zeros((0, 4), np.float32),
    }
    header, found = unpack(pack({"ask": 7, "title": "Größe"}, arrays))
    assert header == {"ask": 7, "title": "Größe"}
    assert list(found) == list(arrays)
    for name, array in arrays.items():
        np.testing.assert_array_equal(found[name], array)
        assert found[name].dtype == array.dtype


def test_every_array_is_aligned_for_a_browser():
    for length in range(9):
        body = pack(
            {"pad": "x" * length}, {"a": np.zeros(3, np.uint8), "b": np.ones(2, np.float32)}
        )
        (size,) = struct.unpack_from("<I", body)
        listed = json.loads(body[4 : 4 + size])["arrays"]
        assert [(4 + size + part["offset"]) % 8 for part in listed] == [0, 0]


def test_a_frame_holds_no_other_kinds():
    with pytest.raises(TypeError, match="heights is float64"):
        pack({}, {"heights": np.zeros(3)})


def test_a_header_holds_no_numbers_that_json_does_not():
    with pytest.raises(ValueError, match="JSON"):
        pack({"worst": float("nan")}, {})
