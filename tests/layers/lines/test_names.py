import pytest

from relieffab.errors import InputError
from relieffab.layers.lines.names import NAMES, PRINCIPAL, USUAL, chosen


def test_chosen_kinds_come_once_and_in_order_of_strength():
    assert chosen(["ridge", "outline", "ridge"]) == ("outline", "ridge")
    assert chosen(NAMES[::-1]) == NAMES


def test_usual_kinds_are_those_of_the_paper_and_of_parts():
    assert USUAL == ("outline", "contour", "boundary", "crease", "suggestive")
    assert set(USUAL) - set(PRINCIPAL) == {"suggestive"}


@pytest.mark.parametrize("names", [(), ("contours",), ("outline", "")])
def test_unknown_kinds_are_refused(names):
    with pytest.raises(InputError, match="kind of line"):
        chosen(names)
