import tomllib

import pytest

from relieffab.errors import InputError
from relieffab.grbl.profile import read_dump, to_toml
from relieffab.grbl.simulator.settings import Settings


def test_a_dump_becomes_a_profile():
    dump = ["[OPT:V,15,128]", *Settings({31: 300, 11: 0.02}).lines(), "ok"]
    profile = tomllib.loads(to_toml(read_dump(dump), 'My "router"'))
    assert profile["title"] == 'My "router"'
    assert profile["travel"] == [263, 157, 34]
    assert profile["max_rate"] == [1600, 1600, 800]
    assert profile["acceleration"] == [30, 30, 30]
    assert profile["spindle"] == [300, 10000]
    assert profile["junction_deviation"] == 0.02
    assert profile["rx_buffer"] == 128


def test_old_dumps_with_words_behind_the_values_are_read():
    dump = [line + " (x, mm)" for line in Settings().lines()]
    assert read_dump(dump).travel == (263, 157, 34)


def test_half_a_dump_is_refused_with_what_is_missing():
    with pytest.raises(InputError, match=r"\$132 \(travel of Z\)"):
        read_dump(Settings().lines()[:-1])
