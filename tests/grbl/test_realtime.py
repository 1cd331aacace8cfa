from relieffab.grbl.realtime import HELP, KEYS, NORMAL, STOP


def test_keys_are_bytes_that_grbl_obeys_at_once_and_no_reset_among_them():
    for data, _ in KEYS.values():
        assert len(data) == 1
        assert data in b"!~" or data[0] >= 0x80
    assert STOP not in KEYS
    assert all(len(key) == 1 and key in HELP for key in KEYS)
    assert all(byte >= 0x80 for byte in NORMAL)
