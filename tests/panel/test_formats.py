import pytest

from relieffab.errors import InputError
from relieffab.panel.formats import FORMATS, USUAL, chosen


def test_formats_come_once_in_their_own_order():
    assert chosen(["glb", "stl", "glb"]) == ("stl", "glb")
    assert chosen(FORMATS) == FORMATS
    assert chosen(USUAL) == USUAL


def test_what_is_no_format_is_refused():
    with pytest.raises(InputError, match="did you mean stl"):
        chosen(["slt"])
    with pytest.raises(InputError, match="needs a format"):
        chosen([])
