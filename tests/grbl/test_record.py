import json

import pytest

from relieffab.errors import InputError
from relieffab.grbl.record import Record, from_dict

RECORD = Record("ab12", 41, (1.0, 2.0, 3.0), (0.0, 0.0, -5.0), True, "cancelled")


@pytest.mark.parametrize("position", [(1.0, 2.0, 3.0), None])
def test_a_record_survives_being_written(position):
    record = Record("ab12", 41, position, (0.0, 0.0, -5.0), False, "running")
    assert from_dict(json.loads(json.dumps(record.to_dict()))) == record


@pytest.mark.parametrize(
    "damage",
    [{"schema": 2}, {"line": "x"}, {"position": [1, 2]}, {"work_zero": None}],
)
def test_a_damaged_record_is_refused(damage):
    with pytest.raises(InputError, match="record"):
        from_dict(RECORD.to_dict() | damage)


def test_a_record_with_less_is_refused():
    with pytest.raises(InputError, match="damaged"):
        from_dict({"schema": 1})
