"""Settings that make no sense are refused."""

import math

import pytest

from relieffab.errors import InputError
from relieffab.toolpath.settings import Settings


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"tolerance": 0.0}, "tolerance cannot be 0"),
        ({"scallop": 6.0}, "scallop cannot be 6"),
        ({"rest": math.nan}, "rest cannot be nan"),
        ({"angle": math.inf}, "angle is not a number"),
        ({"milling": "up"}, "no such way of milling"),
    ],
)
def test_settings_are_checked(values, word):
    with pytest.raises(InputError, match=word):
        Settings(**values)
