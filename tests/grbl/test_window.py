from relieffab.grbl.window import Window


def test_bytes_are_counted_in_and_out_oldest_first():
    window = Window(10)
    window.sent(0, 6)
    assert window.fits(4)
    assert not window.fits(5)
    window.sent(1, 4)
    assert (len(window), window.bytes) == (2, 10)
    assert window.acknowledged() == 0
    assert window.bytes == 4
    assert window.acknowledged() == 1
    assert window.acknowledged() is None
    assert window.bytes == 0
