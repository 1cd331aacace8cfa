import shutil

import pytest

from relieffab.cli.jobs import Kept
from relieffab.errors import InputError
from relieffab.grbl.program import prepare
from relieffab.grbl.record import Record

PROGRAM = prepare("G0X1\nG0X2")
RECORD = Record(PROGRAM.digest, 2, None, (0.0, 0.0, 0.0), False, "running")


def test_a_record_is_kept_until_the_job_is_done():
    kept = Kept(PROGRAM)
    assert kept.read() is None
    kept.keep(RECORD)
    assert Kept(PROGRAM).read() == RECORD
    assert Kept(prepare("G0X9")).read() is None
    kept.keep(None)
    kept.keep(None)
    assert kept.read() is None


def test_a_damaged_record_names_its_file(own_state):
    kept = Kept(PROGRAM)
    for text in ("{", "{}"):
        (own_state / f"{PROGRAM.digest[:16]}.json").write_text(text)
        with pytest.raises(InputError, match=PROGRAM.digest[:16]):
            kept.read()


def test_a_disk_without_room_for_the_log_is_told_before_the_job(monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(9, 8, 1))
    with pytest.raises(InputError, match="no room for the log"):
        Kept(PROGRAM)
